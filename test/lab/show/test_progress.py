"""Telling how far a run has come."""

import io
from dataclasses import replace

import pytest

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
    assert shown.text(shown.began + 30, 100).endswith("] 0:30, 0:20 left; last 6: 50% goals, reward 1.0, 2x real time")


def test_progress_of_an_evaluation_counts_its_own_episodes():
    shown = progress.Progress(total=20, stream=io.StringIO())
    shown.update([episode(number) for number in range(2501, 2504)])
    assert "episode  3/20" in shown.text(shown.began + 30)


def test_clock():
    assert [progress.clock(seconds) for seconds in (0, 59.6, 3600 + 2 * 60 + 3)] == ["0:00", "1:00", "1:02:03"]


@pytest.mark.parametrize("total", [20, 2500, 1_000_000])
@pytest.mark.parametrize("reward", [1.0, -17201.79])
@pytest.mark.parametrize("seconds", [3, 50_000])
def test_a_line_fits_80_columns_and_tells_the_time_left(total, reward, seconds):
    shown = progress.Progress(total, stream=io.StringIO())
    shown.update([replace(episode(number), reward=reward) for number in range(1, 61)])
    text = shown.text(shown.began + seconds)
    assert len(text) < 80 and " left" in text and "50% goals" in text


def test_a_narrow_terminal_still_gets_count_and_time_left():
    shown = progress.Progress(2500, stream=io.StringIO())
    shown.update([episode(number) for number in range(1, 61)])
    text = shown.text(shown.began + 3, 50)
    assert len(text) <= 50 and text.startswith("  60/2500 [") and " left" in text
