"""limphome-shooting plans inside the simulator; what it does follows from the seed alone."""

import math
import os
import subprocess

import pytest

from conftest import ROOT, TIME_LIMIT_S
from limphome_lab import paths
from limphome_lab.runfolder import EpisodeTail


def drive(out, *assignments, processors=None):
    """An episode of one decision; returns the rows."""
    command = [paths.program("shooting"), "--config", ROOT / "config" / "smoke.ini", "--set", "learning.episodes=1"]
    for assignment in ("episode.step_limit=1", *assignments):
        command += ["--set", assignment]
    with open(out, "w") as file:
        subprocess.run(
            command,
            stdout=file,
            check=True,
            timeout=TIME_LIMIT_S,
            preexec_fn=processors and (lambda: os.sched_setaffinity(0, processors)),
        )
    return EpisodeTail(out).read_new()


def test_drives_ahead_and_straight_at_once(tmp_path):
    (episode,) = drive(tmp_path / "rows.csv", "failure.mode=free", "episode.goal_distance_m=0.1")
    assert (episode.outcome, episode.steps, episode.duration_s) == ("goal", 1, 0.5)
    assert abs(episode.lateral_error_m) < 0.02
    assert abs(episode.heading_change_rad) < 0.1
    assert math.isnan(episode.reward)


def test_same_on_any_number_of_processors_and_other_by_another_seed(tmp_path):
    one = drive(tmp_path / "one.csv", processors={min(os.sched_getaffinity(0))})
    assert one[0].outcome == "timeout"
    drive(tmp_path / "all.csv")
    assert (tmp_path / "one.csv").read_bytes() == (tmp_path / "all.csv").read_bytes()
    drive(tmp_path / "other.csv", "learning.seed=2")
    assert (tmp_path / "one.csv").read_bytes() != (tmp_path / "other.csv").read_bytes()


@pytest.mark.parametrize("option", [["--set", "episode.step_limit=0"], ["--robot", "none.urdf"]])
def test_bad_input_starts_nothing(option):
    result = subprocess.run([paths.program("shooting"), *option], capture_output=True, text=True)
    assert (result.returncode, result.stdout) == (2, "")
    assert result.stderr
