"""Telling how far a run has come."""

import io

from limphome_lab.runfolder import Episode
from limphome_lab.show import progress


def episode(number):
    outcome = "goal" if number % 2 else "timeout"
    known = {"episode": number, "outcome": outcome, "duration_s": 10.0, "reward": 1.0}
    return Episode(**dict.fromkeys(Episode.__annotations__, 0) | known)


def test_progress_of_a_resumed_run_counts_from_its_checkpoint():
    shown = progress.Progress(total=20, done=10, stream=io.StringIO())
    shown.update([episode(number) for number in range(1, 17)])
    assert shown.done == 16
    assert shown.simulated_s == 6 * 10.0
    assert "episode 16/20" in shown.text(shown.began + 30)
    assert "last 6: goals  50%, reward    1.00 |    2x real time, 0:30, 0:20 left" in shown.text(shown.began + 30)


def test_progress_of_an_evaluation_counts_its_own_episodes():
    shown = progress.Progress(total=20, stream=io.StringIO())
    shown.update([episode(number) for number in range(2501, 2504)])
    assert "episode  3/20" in shown.text(shown.began + 30)


def test_clock():
    assert [progress.clock(seconds) for seconds in (0, 59.6, 3600 + 2 * 60 + 3)] == ["0:00", "1:00", "1:02:03"]
