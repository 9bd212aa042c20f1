"""A study end to end: interrupted, gone on with, changed, and with a run that fails."""

import os
import re
import signal

import pytest

from conftest import ROOT, TIME_LIMIT_S, processes_that_mention, run_script, start_script, wait_until
from limphome_lab.runfolder import RunFolder

TABLE = """
episodes = 15
[seeds]
tuning = [1]
test = [11, 12]
[variants.learner]
config = "paper.ini"
robot = "{robot}"
episode.step_limit = 20
[failures.free]
failure.mode = "{mode}"
[grounds.flat]
[evaluations.greedy]
episode.goal_distance_m = 1
"""


@pytest.fixture
def study(tmp_path):
    """Writes the table and returns the words of the command."""

    def study(mode="free", robot="crawler.urdf"):
        (tmp_path / "tiny.toml").write_text(TABLE.format(mode=mode, robot=robot))
        return ["study", tmp_path / "tiny.toml", "--out", tmp_path / "study"]

    return study


def complete(folder):
    """{name: when it was made} of the folders of runs and evaluations that are whole."""
    found = [each for kind in ("runs", "evaluations") for each in (folder / kind).glob("*")]
    return {each.name: (each / "episodes.csv").stat().st_mtime_ns for each in found if each.suffix != ".part"}


def test_interrupted_gone_on_with_and_changed(study, tmp_path):
    process = start_script(*study(), "--cores", 1)
    wait_until(process, lambda: complete(tmp_path / "study"))
    os.killpg(process.pid, signal.SIGINT)
    process.communicate(timeout=TIME_LIMIT_S)
    assert process.returncode == 130
    assert processes_that_mention(tmp_path / "study") == []
    before = complete(tmp_path / "study")
    assert 0 < len(before) < 6

    planned = run_script(*study(), "--dry-run").stdout.splitlines()
    assert sum(line.startswith("done") for line in planned) == len(before)
    assert len(planned) == 6

    run_script(*study())
    first = complete(tmp_path / "study")
    assert len(first) == 6
    assert first.items() >= before.items(), "what was done is not done again"
    assert not list((tmp_path / "study").glob("*/*.part"))
    report = (tmp_path / "study" / "report.md").read_text()
    assert "Tuning seeds: 1. Test seeds: 11-12." in report
    assert "Not counted" not in report
    assert (tmp_path / "study" / "report.html").exists()
    settings = [RunFolder(each).settings() for each in sorted((tmp_path / "study" / "runs").iterdir())]
    assert [each["learning"]["seed"] for each in settings] == ["1", "11", "12"]

    run_script(*study(mode="weak"))
    second = complete(tmp_path / "study")
    assert len(second) == 12
    assert second.items() >= first.items(), "the runs of other settings stay beside"


def test_failed_runs_are_told_of(study, tmp_path):
    (tmp_path / "broken.urdf").write_text("<robot/>")
    result = run_script(*study(robot="broken.urdf"), check=False)
    assert result.returncode == 1
    assert complete(tmp_path / "study") == {}
    report = (tmp_path / "study" / "report.md").read_text()
    assert report.count("| run | failed: ") == 3


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('mode = "free"', 'mode = "tired"', "learner-free-flat: --set failure.mode=tired"),
        ("crawler.urdf", "none.urdf", "none.urdf: no such file"),
        ('"paper.ini"', '"none.ini"', "learner-free-flat: .*none.ini: cannot be opened"),
        ("goal_distance_m = 1", "goal_distance_m = -1", "evaluations.greedy of learner-free-flat: "),
    ],
)
def test_bad_table_starts_nothing(tmp_path, old, new, words):
    text = TABLE.format(mode="free", robot="crawler.urdf")
    assert old in text
    (tmp_path / "tiny.toml").write_text(text.replace(old, new))
    result = run_script("study", tmp_path / "tiny.toml", "--out", tmp_path / "study", check=False)
    assert result.returncode == 2
    assert result.stderr.startswith(str(tmp_path / "tiny.toml"))
    assert re.search(words, result.stderr)
    assert not (tmp_path / "study").exists()


def test_shipped_example():
    planned = run_script("study", ROOT / "config" / "studies" / "smoke.toml", "--dry-run").stdout.splitlines()
    assert len(planned) == 6
