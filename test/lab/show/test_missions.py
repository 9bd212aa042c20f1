"""What driving along a path comes to."""

import lcm
import pytest

from limphome import episode_t
from limphome_lab.channels import EPISODE
from limphome_lab.show.missions import missions, summarise


def episode(session, outcome=episode_t.GOAL, arrived=0, error=0.0):
    message = episode_t()
    message.session, message.outcome, message.arrived = session, outcome, arrived
    message.duration, message.waypoint_distance = 7.5, error
    return message


EPISODES = [
    episode(5),
    episode(5, arrived=1, error=0.25),
    episode(9, outcome=episode_t.TIMEOUT),
    episode(9, outcome=episode_t.TUMBLE),
    episode(7),  # broken off
    episode(3, arrived=1, error=0.75),
    episode(4),  # goes on when the run ends
]


@pytest.fixture
def log(tmp_path):
    path = tmp_path / "messages.lcmlog"
    out = lcm.EventLog(str(path), "w")
    for number, message in enumerate(EPISODES):
        out.write_event(number, EPISODE, message.encode())
    out.close()
    return path


def test_a_mission_is_a_session_that_arrived_or_tumbled(log):
    assert [[episode.session for episode in episodes] for episodes in missions(log)] == [[5, 5], [9, 9], [3]]


def test_summary(log):
    assert summarise(missions(log)) == {
        "missions": 3,
        "arrived": 2,
        "median_final_error_m": 0.5,
        "worst_final_error_m": 0.75,
        "median_mission_s": 11.25,
    }


def test_summary_of_none():
    assert summarise([])["missions"] == 0
    assert summarise([])["median_final_error_m"] is None
