"""docs/results.md says what is in the run folders."""

import json

import pytest

from limphome_lab.runfolder import Episode, InputError
from limphome_lab.study import results

MANIFEST = {
    "config": "paper",
    "seed": 1,
    "result": "finished",
    "wall_time_s": 3725.0,
    "real_time_factor": 41.4,
    "decisions": 1234,
    "decisions_per_s": 20.6,
    "simulator_share": 0.77,
    "controller_share": 0.11,
    "link_share": 0.12,
    "revision": {"commit": "a" * 40, "dirty": True},
    "machine": {"cpu": "Some CPU", "cores": 4, "os": "Debian"},
}


def make_run(path, seed=1, **changes):
    """A run of 40 episodes: the first tenth tumbles, the rest gets better by the episode."""
    (path / "figures").mkdir(parents=True)
    for name in results.FIGURES:
        (path / "figures" / f"{name}.png").write_bytes(b"image of seed %d" % seed)
    (path / "config.ini").write_text(f"[learning]\nseed = {seed}\n")
    (path / "robot.urdf").write_text(results.OWN_ROBOT.read_text())
    rows = [
        f"{n},{'tumble' if n <= 4 else 'goal'},{200 - n},{100 - n},{n - 20},0,0,0,0,{-1 / n},0,1" for n in range(1, 41)
    ]
    header = ",".join(Episode.__dataclass_fields__)
    (path / "episodes.csv").write_text("\n".join([header, *rows]) + "\n")
    (path / "manifest.json").write_text(json.dumps({**MANIFEST, "seed": seed, **changes}))
    return path


@pytest.fixture
def out(tmp_path):
    return tmp_path / "out"


def test_row_tells_how_it_ended(tmp_path, out):
    text = results.document([results.Run(make_run(tmp_path / "run"))], out)
    # medians over episodes 37 to 40; in the first window of 20 with 19 goals, 4 to 23, they take 86.5 s at the median
    assert "| 1 | never |  | 100 | 61.5 | 0.03 | 0.00 | 18.50 | 4 |" in text
    assert "last 4 of 40 episodes" in text
    assert "**Learned on 0 of 1 seeds.**" in text
    assert "Each run took 1:02:05 for 1234 decisions, 21 a second" in text and "77% + 11% + 12%" in text
    assert "Some CPU, 4 cores, Debian; revision `aaaaaaaaaa` with changes." in text


def test_a_run_over_before_it_was_measured_is_told_of_without(tmp_path, out):
    run = make_run(tmp_path / "run")
    unmeasured = {
        name: value for name, value in MANIFEST.items() if name != "decisions" and not name.endswith("_share")
    }
    (run / "manifest.json").write_text(json.dumps({**unmeasured, "seed": 1, "wall_time_s": 0.8}))
    text = results.document([results.Run(run)], out)
    assert "Each run took 0:01. Some CPU" in text
    measured = make_run(tmp_path / "measured", seed=2)
    assert "for 1234 decisions" in results.document([results.Run(run), results.Run(measured)], out)


def test_learned_is_told_in_episodes_and_decisions(tmp_path, out):
    run = make_run(tmp_path / "run")
    rows = (run / "episodes.csv").read_text().splitlines()
    quick = [",".join([*row.split(",")[:3], "9", *row.split(",")[4:]]) for row in rows[7:]]
    (run / "episodes.csv").write_text("\n".join([*rows[:7], *quick]) + "\n")
    text = results.document([results.Run(run)], out)
    # of episodes 4 to 23 the first is no goal; those of 1 to 3 have 199, 198 and 197 steps
    assert "| 1 | 3 | 594 | 100 | 9.0 |" in text
    assert "**Learned on 1 of 1 seeds, after 3 episodes, 3 at the median.**" in text


@pytest.mark.parametrize("goals, duration, learned", [(19, 12, 0), (18, 12, None), (19, 12.5, None)])
def test_what_counts_as_learned(goals, duration, learned):
    known = dict.fromkeys(Episode.__annotations__, 0) | {"duration_s": duration}
    episodes = [Episode(**known | {"outcome": "goal" if n < goals else "timeout"}) for n in range(20)]
    assert results.learned_after(episodes) == learned


def test_too_few_episodes_to_have_learned():
    assert results.learned_after([]) is None


def test_run_that_is_too_short_to_have_learned_is_not_told_to_have_failed(tmp_path, out):
    run = make_run(tmp_path / "run")
    rows = (run / "episodes.csv").read_text().splitlines()
    (run / "episodes.csv").write_text("\n".join(rows[:20]) + "\n")
    text = results.document([results.Run(run)], out)
    assert "**19 episodes are too few to have learned by.**" in text and "never" not in text


def test_runs_are_grouped_by_experiment_and_ordered_by_seed(tmp_path, out):
    runs = [make_run(tmp_path / "b", 2), make_run(tmp_path / "a", 1), make_run(tmp_path / "c", 1, config="other")]
    right = make_run(tmp_path / "d", 1)
    (right / "config.ini").write_text("[learning]\nseed = 1\n[failure]\nactuator = right_crawler\nmode = locked\n")
    text = results.document([results.Run(path) for path in [*runs, right]], out)
    headings = [line for line in text.splitlines() if line.startswith("#")]
    assert headings == [
        "# Results",
        "## The paper's method",
        "### other",
        "### paper",
        "### paper, actuator = right_crawler",
    ]
    assert text.index("| 1 | never") < text.index("| 2 | never")
    assert "](images/paper-actuator-right_crawler-seeds.png)" in text


def test_learners_have_sections_with_what_was_written_of_them(tmp_path, out):
    out.mkdir()
    (out / "results_q_learning.md").write_text("What we make of it.\n")
    planned = make_run(tmp_path / "planned", config="mine")
    (planned / "config.ini").write_text("[learning]\nseed = 1\n[learner]\nkind = planner\n")
    text = results.document([results.Run(planned), results.Run(make_run(tmp_path / "run"))], out)
    assert "## The paper's method\n\nWhat we make of it.\n\n" in text
    assert text.index("### paper\n") < text.index("## The planner") < text.index("### mine, kind = planner")
    assert "Stable-Baselines3" not in text
    (out / "results_stable_baselines3.md").write_text("What it came to.\n")
    text = results.document([results.Run(planned)], out)
    assert text.endswith("\n\n## A learner of others: DQN of Stable-Baselines3\n\nWhat it came to.\n")


def test_figures_are_copied_beside_the_page(tmp_path, out):
    text = results.document([results.Run(make_run(tmp_path / "run", 7))], out)
    assert "](images/paper-seed7-fig8_reward.png)" in text
    assert (out / "images" / "paper-seed7-fig8_reward.png").read_bytes() == b"image of seed 7"


def test_figures_are_those_of_the_seed_that_ended_best(tmp_path, out):
    poor, good = make_run(tmp_path / "poor", 1), make_run(tmp_path / "good", 2)
    rows = (poor / "episodes.csv").read_text().splitlines()
    (poor / "episodes.csv").write_text(
        "\n".join(
            [*rows[:-4], *(row.replace("goal", "timeout").replace(row.split(",")[4], "-150") for row in rows[-4:])]
        )
        + "\n"
    )
    text = results.document([results.Run(poor), results.Run(good)], out)
    assert "](images/paper-seed2-fig8_reward.png)" in text
    assert "](images/paper-seeds.png)" in text
    assert (out / "images" / "paper-seeds.png").stat().st_size > 10_000


def test_run_that_has_not_finished_is_refused(tmp_path):
    with pytest.raises(InputError, match="not finished"):
        results.Run(make_run(tmp_path / "run", result="interrupted"))


def test_one_seed_does_not_count_twice(tmp_path, out):
    runs = [results.Run(make_run(tmp_path / name, 1)) for name in ("one", "other")]
    with pytest.raises(InputError, match=r"seed 1 of paper would count twice: .*one and .*other"):
        results.document(runs, out)


def test_another_robot_is_another_experiment(tmp_path, out):
    other = make_run(tmp_path / "other", 2)
    (other / "robot.urdf").write_text(results.OWN_ROBOT.with_name("two_arm.urdf").read_text())
    text = results.document([results.Run(make_run(tmp_path / "one", 1)), results.Run(other)], out)
    assert "### paper\n" in text and "### paper, robot = two_arm" in text


def test_the_page_tells_its_revision(tmp_path, out):
    assert "by revision `aaaaaaaaaa`" in results.document([results.Run(make_run(tmp_path / "run"))], out)


def test_an_evaluation_is_no_result(tmp_path):
    with pytest.raises(InputError, match="is an evaluation"):
        results.Run(make_run(tmp_path / "run", kind="evaluation"))
