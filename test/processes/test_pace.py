"""A person at a viewer pauses, steps, slows and puts back a run: it looks closer, and changes no byte."""

import time

import pytest

from bus import Bus, controller, inside, simulator
from limphome import pace_t, pose_t, status_t
from limphome_lab.channels import PACE, POSE
from limphome_lab.runfolder import RunFolder

SHORT = ["learning.episodes=6", "episode.reset_every=3", "episode.step_limit=40", "sensors.joint_noise=0.002"]
HASTY = ["link.give_up_s=1", "link.sender_timeout_s=0.5"]


def say(bus, action, pace=0.0):
    message = pace_t()
    message.action, message.pace = action, pace
    bus.say(PACE, message)


def poses(bus):
    return [pose_t.decode(data) for channel, data in bus.heard if channel == POSE]


def look(bus, seconds):
    """Somebody does: listens, and says so."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        say(bus, pace_t.KEEP)
        bus.listen(min(1.0, end - time.monotonic()))


def undisturbed(_bus):
    return {}


def looked_at_closely(bus):
    """Paused at a state and within a decision period, for longer than anybody waits, stepped and slowed."""
    bus.until(lambda: bus.states and bus.state.seq > 3)
    seen = {}
    say(bus, pace_t.PAUSE)
    look(bus, 1.6)
    bus.heard.clear()
    look(bus, 0.4)
    seen["paused"] = [[pose.utime, pose.seq, pose.pace, bus.state.seq] for pose in poses(bus)]
    seen["conditions"] = [[s.condition, s.reason] for each in bus.statuses.values() for s in each[-1:]]

    seq = bus.state.seq
    for _ in range(3):
        say(bus, pace_t.STEP)
        look(bus, 0.2)
    seen["stepped"] = bus.state.seq - seq

    say(bus, pace_t.RUN, 0.5)
    look(bus, 0.3)
    bus.heard.clear()
    begun = time.monotonic()
    look(bus, 0.5)
    first, last = poses(bus)[0], poses(bus)[-1]
    seen["slow"] = [last.pace, last.utime - first.utime, time.monotonic() - begun]

    say(bus, pace_t.PAUSE)  # within a decision period, which lasts a second now
    look(bus, 0.1)
    bus.heard.clear()
    look(bus, 1.6)
    seen["within"] = [[pose.utime, pose.utime % 500_000] for pose in poses(bus)]
    say(bus, pace_t.RUN, pose_t.PACE_FREE)
    return seen


def put_back(bus):
    bus.until(lambda: bus.states and bus.state.seq > 20)
    session = bus.state.session
    say(bus, pace_t.RESET)
    bus.until(lambda: bus.state.session != session)
    return {"owner": bus.state.reset_sender}


def left_alone(bus):
    """The viewer is killed with the plant paused."""
    bus.until(lambda: bus.states and bus.state.seq > 3)
    say(bus, pace_t.PAUSE)
    bus.listen(0.5)
    return {"paused": bus.statuses[status_t.PLANT][-1].reason}


def run(folder, person, assignments):
    """A run to its end, with a person looking at it; what was seen."""
    with Bus(folder) as bus:
        bus.keep = (POSE,)
        bus.start(simulator(*SHORT, *assignments))
        learns = bus.start(controller(f"{folder}/run", *SHORT, *assignments))
        seen = globals()[person](bus)
        bus.until(lambda: not learns.running(), 60)
        return {
            "exit": learns.end(),
            "words": learns.words(),
            "plant": vars_of(bus.statuses[status_t.PLANT][-1]),
            **seen,
        }


def vars_of(status):
    return {name: getattr(status, name) for name in status.__slots__}


def result(folder):
    run_folder = RunFolder(folder / "run")
    return run_folder.policy.read_bytes(), run_folder.episodes.read_bytes()


@pytest.fixture(scope="module")
def bytes_of_an_undisturbed_run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("undisturbed")
    assert inside(run, str(folder), "undisturbed", [])["exit"] == 0
    return result(folder)


def test_looking_closer_changes_no_byte(tmp_path, bytes_of_an_undisturbed_run):
    seen = inside(run, str(tmp_path), "looked_at_closely", HASTY)
    print(seen)
    assert seen["exit"] == 0, seen["words"]
    assert result(tmp_path) == bytes_of_an_undisturbed_run


def test_a_reset_costs_time_only(tmp_path, bytes_of_an_undisturbed_run):
    seen = inside(run, str(tmp_path), "put_back", [])
    print(seen)
    assert seen["exit"] == 0, seen["words"]
    assert "begun anew; back to the end of episode" in seen["words"]
    assert result(tmp_path) == bytes_of_an_undisturbed_run


def test_a_viewer_that_is_killed_stops_no_run(tmp_path, bytes_of_an_undisturbed_run):
    seen = inside(run, str(tmp_path), "left_alone", [])
    print(seen)
    assert seen["exit"] == 0, seen["words"]
    assert result(tmp_path) == bytes_of_an_undisturbed_run
