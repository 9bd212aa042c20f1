"""What a stretch of episodes comes to."""

import pytest

from limphome_lab.runfolder import Episode
from limphome_lab.show.summary import summarise


def episode(number, outcome, duration, reward, lateral):
    known = {
        "episode": number,
        "outcome": outcome,
        "duration_s": duration,
        "reward": reward,
        "lateral_error_m": lateral,
    }
    return Episode(**dict.fromkeys(Episode.__annotations__, 0) | known)


def test_summary():
    summary = summarise(
        [
            episode(1, "goal", 8, 5, -0.2),
            episode(2, "timeout", 100, -3, 0.4),
            episode(3, "tumble", 9, -9, 0.1),
            episode(4, "goal", 7, 6, 0.3),
        ]
    )
    assert summary["goal_share"] == 0.5
    assert (summary["tumbles"], summary["timeouts"]) == (1, 1)
    assert summary["median_duration_s"] == 8.5
    assert summary["median_lateral_error_m"] == pytest.approx(0.25)
    assert summary["median_reward"] == 1.0
