"""Tables of studies: what they say, and what is refused, naming file and key."""

import pytest

from limphome_lab.runfolder import InputError
from limphome_lab.study import table

WHOLE = """
episodes = 30
[seeds]
tuning = [1, "3-5"]
test = ["101-102"]
[variants.one]
config = "paper.ini"
learning.discount_rate = 0.8
[variants.two]
hard = true
[failures.left]
failure.actuator = "left_crawler"
failure.mode = "free"
[failures.right]
failure.actuator = "right_crawler"
[grounds.flat]
[grounds.uphill]
ground.incline_along_rad = 0.14
[evaluations.greedy]
episodes = 2
selection = "greedy"
episode.goal_distance_m = 10
"""


@pytest.fixture
def read(tmp_path):
    def read(text):
        (tmp_path / "tiny.toml").write_text(text)
        return table.read(tmp_path / "tiny.toml")

    return read


def test_each_with_each(read):
    found = read(WHOLE)
    assert (found.name, found.episodes) == ("tiny", 30)
    assert found.seeds == {"tuning": [1, 3, 4, 5], "test": [101, 102]}
    assert [case.name for case in found.cases] == [
        f"{variant}-{failure}-{ground}"
        for variant in ("one", "two")
        for failure in ("left", "right")
        for ground in ("flat", "uphill")
    ]
    assert found.cases[1].settings == [
        "learning.discount_rate=0.8",
        "failure.actuator=left_crawler",
        "failure.mode=free",
        "ground.incline_along_rad=0.14",
    ]
    assert [case.hard for case in found.cases] == [False] * 4 + [True] * 4
    assert found.evaluations[0].settings == ("episode.goal_distance_m=10",)
    assert found.evaluations[0].get("episodes") == 2


def test_crosses_say_which_and_none_comes_twice(read):
    crosses = '[[cross]]\nvariants = ["one"]\ngrounds = ["flat"]\n[[cross]]\nvariants = ["one"]\nfailures = ["left"]\n'
    names = [case.name for case in read(WHOLE + crosses).cases]
    assert names == ["one-left-flat", "one-right-flat", "one-left-uphill"]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("episodes = 30", "episode = 30", "episode: not known; allowed are episodes, seeds"),
        ("episodes = 30", "episodes = 0", "episodes: must be a whole number from 1"),
        ("episodes = 30", "episodes = true", "episodes: must be a whole number from 1"),
        ("episodes = 30", "episodes = ", "not TOML"),
        ('[1, "3-5"]', '[1, "5-3"]', "seeds.tuning: must be a list of seeds from 0 to 2147483647"),
        ('[1, "3-5"]', "[1, -1]", "seeds.tuning: must be a list"),
        ('[1, "3-5"]', '[4, "3-5"]', "seeds.tuning: must be a list.* none of them twice"),
        ('[1, "3-5"]', "[101]", "seeds: a seed is for tuning or for the test"),
        ("test =", "tests =", "seeds.tests: not known; allowed are tuning, test"),
        ("[variants.one]", '[variants."a b"]', "variants.a b: a name is made of letters, digits and _"),
        (
            "config =",
            "confg =",
            "variants.one.confg: not known; allowed are config, robot, episodes, hard, reference and settings",
        ),
        ('config = "paper.ini"', "config = 3", "variants.one.config: must be a text"),
        ("0.8", "[0.8]", "variants.one.learning.discount_rate: a setting must be a number or a text"),
        ("learning.discount_rate", "learning.seed", "variants.one.learning.seed: is given by seeds"),
        (
            'selection = "greedy"',
            'selection = "best"',
            "evaluations.greedy.selection: must be one of greedy, boltzmann",
        ),
        ("[grounds.flat]\n[grounds.uphill]", "[other]", "other: not known; allowed are"),
        (
            "goal_distance_m = 10",
            'goal_distance_m = 10\n[[cross]]\nvariants = ["three"]',
            "cross 1.variants: must be a list of some of one, two",
        ),
        ("goal_distance_m = 10", "goal_distance_m = 10\n[cross]", "cross: must be written as"),
    ],
)
def test_bad_tables_are_refused(read, tmp_path, old, new, message):
    assert old in WHOLE
    with pytest.raises(InputError, match=message) as refused:
        read(WHOLE.replace(old, new))
    assert str(refused.value).startswith(str(tmp_path / "tiny.toml"))


def test_without_ground_or_seeds_there_is_nothing_to_run(read):
    with pytest.raises(InputError, match=r"grounds: there must be at least one \[grounds.NAME\]"):
        read(WHOLE.replace("[grounds.flat]\n[grounds.uphill]\nground.incline_along_rad = 0.14", ""))
    with pytest.raises(InputError, match="seeds: must name some"):
        read(WHOLE.replace('tuning = [1, "3-5"]\ntest = ["101-102"]', ""))


def test_missing_file(tmp_path):
    with pytest.raises(InputError, match="cannot be read: No such file"):
        table.read(tmp_path / "none.toml")
