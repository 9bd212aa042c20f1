"""Each finding, on episodes and tracks made by hand, and none on those of a run that drives well."""

import math
from types import SimpleNamespace

import pytest

from limphome_lab.runfolder import Episode
from limphome_lab.show import findings
from limphome_lab.show.findings import Evidence, Track

Q_LEARNING = {
    "learner": {"kind": "q_learning"},
    "learning": {"episodes": "2500"},
    "rbf": {"gradient": "printed"},
    "action": {"crawler_speed": "0.3", "joint_speed": "0.3"},
    "reward": {"forward": "8", "turn": "10", "stability": "1", "tumble": "-10"},
    "episode": {"decision_period_s": "0.5", "step_limit": "200", "tumble_tilt_rad": "1.05"},
}
PLANNER = Q_LEARNING | {
    "learner": {"kind": "planner"},
    "planner": {"steering": "1.5", "unsafe": "3", "random_share": "0.01"},
}
STRAIGHT = Track(2.1, 2.05, 2.05, 0.05, 0.35, 2.0)
ROUND = Track(25.0, 2.1, 2.5, -14.6, 0.15, 2.0)
TO_AND_FRO = Track(4.1, 0.3, 0.7, 0.4, 0.3, 2.0)
STILL = Track(0.03, 0.01, 0.02, 0.02, 0.015, 2.0)


def row(outcome):
    return Episode(1, outcome, 14, 7.0, 0, 0, 0, 0, 0, 0.02, 0.01, 0.25)


def evidence(track, outcome="timeout", count=20, settings=Q_LEARNING, **more):
    return Evidence(settings, [row(outcome)] * count, [track] * count, **more)


def names(seen):
    return [finding.name for finding in findings.findings(seen)]


@pytest.mark.parametrize("settings", [Q_LEARNING, PLANNER])
def test_nothing_is_found_where_it_drives_well(settings):
    assert names(evidence(STRAIGHT, "goal", settings=settings, saturated_share=0.01)) == []


@pytest.mark.parametrize("settings", [Q_LEARNING, PLANNER])
def test_circling(settings):
    seen = evidence(ROUND, settings=settings)
    assert names(seen) == ["circling", "never reaching"]
    found = findings.circling(seen)
    assert found.numbers == {"way_m": 25.0, "net_m": 2.1, "turned_rad": 14.6, "share": 1}
    assert "25.0 m of way end 2.1 m from where they began, after 2.3 turns" in found.text
    key = "planner.steering above 1.5" if settings is PLANNER else "rbf.gradient = exact: the printed one rarely learns"
    assert key in found.advice


@pytest.mark.parametrize("track", [Track(25, 6.3, 7, 14, 0.3, 2), Track(25, 2, 7, 6.2, 0.3, 2)])
def test_a_bend_or_half_a_circle_is_not_circling(track):
    assert findings.circling(evidence(track)) is None


def test_half_of_the_episodes_must_circle():
    rows = [row("timeout")] * 20
    assert findings.circling(Evidence(Q_LEARNING, rows, [ROUND] * 10 + [STRAIGHT] * 10)).numbers["share"] == 0.5
    assert findings.circling(Evidence(Q_LEARNING, rows, [ROUND] * 9 + [STRAIGHT] * 11)) is None


@pytest.mark.parametrize("settings", [Q_LEARNING, PLANNER])
def test_standing(settings):
    found = findings.standing(evidence(STILL, settings=settings))
    assert found.numbers == {"farthest_m": 0.02, "share": 1}
    assert ("planner.random_share above 0.01" in found.advice) == (settings is PLANNER)
    assert findings.standing(evidence(TO_AND_FRO, settings=settings)) is None


def test_turning_on_the_spot_is_circling_and_not_standing():
    seen = evidence(Track(0.8, 0.02, 0.05, 7.0, 0.1, 2))
    assert "circling" in names(seen) and "standing" not in names(seen)


@pytest.mark.parametrize("settings", [Q_LEARNING, PLANNER])
def test_never_reaching(settings):
    seen = evidence(TO_AND_FRO, settings=settings)
    assert names(seen) == ["never reaching"]
    assert findings.never_reaching(seen).numbers["episodes"] == 20


def test_never_is_20_episodes_without_a_single_goal():
    assert names(evidence(TO_AND_FRO, count=19)) == ["seldom reaching"]
    seen = evidence(TO_AND_FRO)
    seen.episodes = [row("goal")] + [row("timeout")] * 19
    assert names(seen) == ["seldom reaching"]
    assert "1 goal in 20 episodes" in findings.findings(seen)[0].text


def test_seldom_is_told_where_nothing_else_tells_why():
    seen = evidence(STRAIGHT)
    seen.episodes = [row("goal")] * 18 + [row("timeout")] * 2
    assert names(seen) == ["seldom reaching"]
    seen.saturated_share = 0.3
    assert names(seen) == ["saturated drives"]
    seen = evidence(STRAIGHT)
    seen.episodes = [row("goal")] * 19 + [row("timeout")]
    assert names(seen) == []


def test_exploration_ended():
    found = findings.exploration_ended(evidence(TO_AND_FRO, num_actions=1.2))
    assert found.numbers == {"temperature": 0.25, "num_actions": 1.2}
    assert "exploration.temperature_floor above 0.25" in found.advice
    assert findings.exploration_ended(evidence(TO_AND_FRO, num_actions=3)) is None


def test_saturated_drives():
    found = findings.saturated_drives(evidence(TO_AND_FRO, saturated_share=0.3))
    assert found.numbers == {"share": 0.3} and "30%" in found.text
    assert findings.saturated_drives(evidence(TO_AND_FRO, saturated_share=0.09)) is None


@pytest.mark.parametrize("settings", [Q_LEARNING, PLANNER])
def test_tumbling(settings):
    seen = evidence(STRAIGHT, "goal", settings=settings)
    seen.episodes = [row("tumble")] * 2 + [row("goal")] * 18
    found = findings.tumbling(seen)
    assert found.numbers == {"share": 0.1} and "1.05 rad" in found.text
    assert ("planner.unsafe above 3" in found.advice) == (settings is PLANNER)
    seen.episodes = [row("tumble")] + [row("goal")] * 19
    assert findings.tumbling(seen) is None


def test_what_tumbles_is_not_said_to_never_reach():
    assert names(evidence(TO_AND_FRO, "tumble")) == ["tumbling"]


def test_goal_that_cannot_be_reached():
    far = Track(14.4, 14.3, 14.3, 0.1, 0.4, 50.0)  # 200 decisions of 0.5 s: 40 m at most
    seen = evidence(far)
    assert names(seen) == ["a goal that cannot be reached"]
    found = findings.unreachable_goal(seen)
    assert found.numbers == {"best_speed_m_s": 0.4, "time_limit_s": 100, "goal_distance_m": 50}
    assert found.advice == ["episode.goal_distance_m below 40.00", "episode.step_limit above 250"]
    assert findings.unreachable_goal(evidence(Track(14.4, 14.3, 14.3, 0.1, 0.5, 50.0))) is None


def test_more_time_does_not_help_what_stands():
    found = findings.unreachable_goal(evidence(STILL))
    assert found.advice == ["episode.goal_distance_m below 1.50"]


def state(x, y, heading):
    return SimpleNamespace(position=(x, y, 0.3), orientation=(math.cos(heading / 2), 0, 0, math.sin(heading / 2)))


def test_track_of_two_turns():
    angles = [2 * math.pi * k / 8 for k in range(17)]
    poses = [findings.pose(state(math.sin(angle), 1 - math.cos(angle), angle + 3)) for angle in angles]
    track = findings.track(poses, 2.0, 0.5)
    chord = 2 * math.sin(math.pi / 8)
    assert track.way_m == pytest.approx(16 * chord)
    assert track.net_m == pytest.approx(0, abs=1e-9)
    assert track.farthest_m == pytest.approx(2)
    assert track.turned_rad == pytest.approx(4 * math.pi)  # its heading passes pi on the way
    assert track.best_speed_m_s == pytest.approx(chord / 0.5)
    assert track.circles


def test_effective_actions():
    assert findings.effective_actions([0.25] * 10) == pytest.approx(4)
    assert findings.effective_actions([1.0] * 10) == 1
    assert findings.effective_actions([0.5, 0.125]) == pytest.approx(4)


def statuses(*pairs):
    return [SimpleNamespace(simulated_time=time, saturated=count) for time, count in pairs]


def test_saturated_share_is_that_of_the_span():
    told = statuses((0, 0), (10, 5000), (20, 5100), (30, 5300))
    # 300 of 20 s / 0.005 s * 5 drives
    assert findings.saturated_share(told, 15.0, 0.005, 5) == pytest.approx(300 / 20000)
    assert findings.saturated_share(told, 100.0, 0.005, 5) == pytest.approx(5300 / 30000)


def test_saturated_share_of_a_plant_that_was_started_anew():
    assert findings.saturated_share(statuses((90, 9000), (1, 0), (2, 20)), 60.0, 0.005, 5) == pytest.approx(20 / 2000)


def test_saturated_share_of_a_real_machine():
    assert findings.saturated_share(statuses((0, 0), (0, 0)), 10.0, 0.005, 5) is None
