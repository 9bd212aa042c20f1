"""Paths through the real processes: what the messages tell of lines, goals and arrivals is true of the states."""

import json
from itertools import pairwise
from math import atan2, cos, hypot, sin

import pytest

from conftest import run_script, train
from limphome_lab.channels import DECISION, EPISODE, STATE
from limphome_lab.messages import recorded
from limphome_lab.runfolder import RunFolder

PATH = [(0.0, 0.15), (0.05, 0.2)]  # near enough for a robot that has learned nothing
ROUNDING = 1e-5  # of single precision, over a few metres [m], [rad]
GOAL_DISTANCE = 0.1
EPISODES = 60


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    out = tmp_path_factory.mktemp("path") / "run"
    way = out.parent / "way.txt"
    way.write_text("".join(f"{x} {y} ; metres\n" for x, y in PATH))
    short = ["episode.step_limit=40", f"episode.goal_distance_m={GOAL_DISTANCE}", f"task.path=waypoints {way}"]
    train(out, "--episodes", EPISODES, *(argument for setting in short for argument in ("--set", setting)))
    way.unlink()  # the run folder is whole without
    return RunFolder(out)


@pytest.fixture(scope="module")
def sessions(run):
    """[(episodes, {utime: state})] from one reset to the next."""
    found = {}
    for channel, message in recorded(run.messages, EPISODE, STATE):
        episodes, states = found.setdefault(message.session, ([], {}))
        if channel == EPISODE:
            episodes.append(message)
        else:
            states[message.utime] = message
    return list(found.values())


def seen_from(line, point):
    """(along, to the left) of a point from the beginning of `line`, (x, y, heading)."""
    x, y = point[0] - line[0], point[1] - line[1]
    return x * cos(line[2]) + y * sin(line[2]), y * cos(line[2]) - x * sin(line[2])


def leg_after(leg, start, position):
    """(number of the leg, its line, its length) on which an episode at `position` begins, after `leg`."""
    while True:
        begin = start if leg == 0 else PATH[leg - 1]
        end = PATH[leg]
        line = (*begin, atan2(end[1] - begin[1], end[0] - begin[0]))
        length = hypot(end[0] - begin[0], end[1] - begin[1])
        if leg == len(PATH) - 1 or seen_from(line, position)[0] < length:
            return leg, line, length
        leg += 1


def test_points_of_the_file_are_in_the_run_folder(run):
    assert run.settings()["task"]["path"] == "to 0 0.15, 0.05 0.2"


def test_lines_and_goals_are_those_of_the_path(sessions):
    legs = set()
    for episodes, states in sessions:
        leg, start = 0, episodes[0].start
        for episode in episodes:
            leg, line, length = leg_after(leg, start, episode.start)
            legs.add(leg)
            along, beside = seen_from(line, episode.start)
            assert episode.line_heading == pytest.approx(line[2], abs=ROUNDING)
            assert episode.start_lateral_error == pytest.approx(beside, abs=ROUNDING)
            assert episode.goal_distance == pytest.approx(min(GOAL_DISTANCE, length - along), abs=ROUNDING)
            end = states[episode.utime].position
            assert episode.lateral_error == pytest.approx(seen_from(line, end)[1], abs=ROUNDING)
            to_waypoint = hypot(end[0] - PATH[leg][0], end[1] - PATH[leg][1])
            assert episode.waypoint_distance == pytest.approx(to_waypoint, abs=ROUNDING)
            assert episode.arrived == (leg == len(PATH) - 1 and seen_from(line, end)[0] >= length)
    assert legs == {0, 1}


def test_the_path_begins_again_after_its_end(sessions):
    arrived = [episodes[-1].arrived for episodes, _ in sessions]
    assert sum(arrived) >= 2
    assert all(not episode.arrived for episodes, _ in sessions for episode in episodes[:-1])
    starts = [episodes[0].start for episodes, _ in sessions]
    assert all(start == starts[0] for start in starts)


def test_decisions_see_the_line_of_their_episode(run):
    lines = {episode.episode: episode for _, episode in recorded(run.messages, EPISODE)}
    decisions = [decision for _, decision in recorded(run.messages, DECISION)]
    for decision, after in pairwise(decisions):
        if decision.step == 0 and after.episode == decision.episode:  # the first of an episode
            episode = lines[decision.episode]
            assert decision.goal_distance == pytest.approx(episode.goal_distance, abs=ROUNDING)
            assert decision.lateral_error == pytest.approx(episode.start_lateral_error, abs=ROUNDING)
            error = episode.start_heading - episode.line_heading - decision.heading_error
            assert cos(error) == pytest.approx(1, abs=ROUNDING) and sin(error) == pytest.approx(0, abs=ROUNDING)


def test_a_resumed_run_begins_the_path_as_an_unbroken_one(tmp_path, run):
    settings = [argument for setting in _settings(run) for argument in ("--set", setting)]
    train(tmp_path / "first", *settings, "--episodes", 20)
    run_script("train", "--resume", tmp_path / "first", "--episodes", EPISODES, "--quiet")
    resumed = RunFolder(tmp_path / "first")
    assert resumed.episodes.read_bytes() == run.episodes.read_bytes()
    assert resumed.policy.read_bytes() == run.policy.read_bytes()


def _settings(run):
    settings = run.settings()
    for section, key in (("episode", "step_limit"), ("episode", "goal_distance_m"), ("task", "path")):
        yield f"{section}.{key}={settings[section][key]}"


def test_evaluation_tells_of_arrivals(run):
    summary = json.loads(run_script("evaluate", run.path, "--episodes", 5, "--json").stdout)
    assert 0 <= summary["arrived"] <= summary["missions"]


def test_the_path_is_drawn(run):
    assert (run.figures / "fig_path.png").read_bytes().startswith(b"\x89PNG\r\n")
