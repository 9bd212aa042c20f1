"""A person at a viewer pauses, steps, slows and puts back a run: it looks closer, and changes no byte."""

import math
import signal
import time

import pytest
from bus import Bus, controller, inside, simulator

from conftest import TIME_LIMIT_S
from limphome import pace_t, pose_t, status_t
from limphome_lab.channels import PACE, POSE
from limphome_lab.runfolder import RunFolder

# with errors of the sensors, so that a reading too much would change what follows
SHORT = ["learning.episodes=6", "episode.reset_every=3", "episode.step_limit=40", "sensors.joint_noise=0.002"]
HASTY = ["link.give_up_s=2", "link.sender_timeout_s=0.5"]
PERIOD_US = 500_000
LOOKS_S = 2.5  # longer than the hasty wait for anything


def say(bus, action, pace=0.0):
    message = pace_t()
    message.action, message.pace = action, pace
    bus.say(PACE, message)


def look(bus, seconds):
    """Listens, and says that somebody looks; the poses of that time."""
    bus.heard.clear()
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        say(bus, pace_t.KEEP)
        bus.listen(min(1.0, end - time.monotonic()))
    return [pose_t.decode(data) for _, data in bus.heard]


def pause(bus):
    """Once the run is under way; until the plant stands still."""
    bus.until(lambda: bus.states and bus.state.seq > 3)
    say(bus, pace_t.PAUSE)
    assert bus.until(lambda: bus.heard and pose_t.decode(bus.heard[-1][1]).pace == 0), "it does not pause"


def undisturbed(_bus, _assignments):
    return {}


def looked_at_closely(bus, _assignments):
    """Paused at a state and within a decision period, for longer than anybody waits, stepped and slowed."""
    pause(bus)
    paused = look(bus, LOOKS_S)
    seen = {"paused": sorted({pose.utime for pose in paused}), "poses": len(paused)}
    seen["told"] = [[statuses[-1].condition, statuses[-1].reason] for statuses in bus.statuses.values()]
    seen["stepped"] = []
    for _ in range(3):
        say(bus, pace_t.STEP)
        seen["stepped"].append(look(bus, 0.3)[-1].utime)
    say(bus, pace_t.RUN, 0.1)  # a decision takes 5 s: it is paused in the midst of one
    slow = [pose for pose in look(bus, LOOKS_S) if pose.pace != 0]  # one may still tell of the pause
    seen["slow"] = [[pose.pace, pose.utime] for pose in (slow[0], slow[-1])]
    say(bus, pace_t.PAUSE)
    look(bus, 0.3)
    seen["within"] = sorted({pose.utime for pose in look(bus, LOOKS_S)})
    say(bus, pace_t.RUN, 100)
    look(bus, 0.3)
    say(bus, pace_t.RUN, pose_t.PACE_FREE)
    return seen


def put_back(bus, _assignments):
    """While it runs, and while it is paused."""
    pause(bus)
    sessions = []
    for action in (pace_t.RESET, pace_t.RUN, pace_t.RESET):
        say(bus, action, pose_t.PACE_FREE)
        bus.until(lambda: bus.state.session not in sessions and bus.state.seq > 5, 1)
        sessions.append(bus.state.session)
    return {}


def put_back_unseen(bus, _assignments):
    """Time and again while the controller is stopped: it hears of the state and of the end of its session at once."""
    learns = bus.programs[-1]
    seen = set()
    for _ in range(4):
        bus.until(lambda: bus.states and bus.state.session not in seen and bus.state.seq > 3)
        learns.signal(signal.SIGSTOP)
        bus.listen(0.05)
        seen.add(bus.state.session)
        say(bus, pace_t.RESET)
        bus.until(lambda: bus.state.session not in seen, 1)
        learns.signal(signal.SIGCONT)
    return {}


def left_alone(bus, _assignments):
    """The viewer is killed while the plant is paused."""
    pause(bus)
    return {}


def taken_over(bus, assignments):
    """The controller is killed while the plant is paused, and another one started."""
    pause(bus)
    bus.programs[-1].signal(signal.SIGKILL)
    bus.start(controller(f"{bus.folder}/run2", *assignments))
    session = bus.state.session
    bus.until(lambda: (say(bus, pace_t.KEEP), bus.state.session != session and bus.state.seq == 0)[1])
    paused = look(bus, 1)
    say(bus, pace_t.RUN, pose_t.PACE_FREE)
    return {"paused": sorted({pose.utime for pose in paused})}


def spoken_to_nonsense(bus, _assignments):
    """Paces that are none, over and over."""
    bus.until(lambda: bus.states and bus.state.seq > 3)
    good = pace_t()
    good.action = pace_t.PAUSE
    for _ in range(50):
        for pace in (math.nan, math.inf, 0.0, -2.0, 0.009, 101.0):
            say(bus, pace_t.RUN, pace)
        for action in (-1, 5, 127):
            say(bus, action, 1.0)
        bus.lcm.publish(PACE, good.encode()[:-1])
        bus.lcm.publish(PACE, good.encode() + b"\0")
        bus.listen(0.002)
    last = bus.status()
    return {"malformed": last.rejected_malformed, "non_finite": last.rejected_non_finite}


def run(folder, person, assignments):
    """A run to its end, with a person looking at it; what was seen."""
    with Bus(folder) as bus:
        bus.keep = (POSE,)
        bus.start(simulator(*SHORT, *assignments))
        bus.start(controller(f"{folder}/run", *SHORT, *assignments))
        seen = globals()[person](bus, [*SHORT, *assignments])
        learns = bus.programs[-1]
        bus.until(lambda: not learns.running(), TIME_LIMIT_S / 2)
        return {"exit": learns.end(), "words": learns.words(), **seen}


def assert_same_bytes(folder, other):
    assert folder.policy.read_bytes() == other.policy.read_bytes()
    assert folder.episodes.read_bytes() == other.episodes.read_bytes()


@pytest.fixture(scope="module")
def unwatched(tmp_path_factory):
    folder = tmp_path_factory.mktemp("undisturbed")
    assert inside(run, str(folder), "undisturbed", [])["exit"] == 0
    return RunFolder(folder / "run")


@pytest.mark.fault(
    "a person pauses, steps and slows the plant",
    injected="longer than link.give_up_s and link.sender_timeout_s, at a state and within a decision period",
    expected="the controller waits; episodes and policy byte for byte those of an undisturbed run",
)
def test_looking_closer_changes_no_byte(tmp_path, unwatched, observe):
    seen = inside(run, str(tmp_path), "looked_at_closely", HASTY)
    assert seen["exit"] == 0, seen["words"]
    assert "silent" not in seen["words"]
    assert "held up by a person" in seen["words"]
    assert len(seen["paused"]) == 1 and seen["paused"][0] % PERIOD_US == 0
    assert 5 < seen["poses"] <= 30 * LOOKS_S + 2
    assert seen["told"] == [[status_t.WAITING, status_t.PACED]] * 2
    assert seen["stepped"] == [seen["paused"][0] + n * PERIOD_US for n in (1, 2, 3)]
    (pace, first), (_, last) = seen["slow"]
    assert pace == 0.1
    assert 0 < last - first <= 0.1 * (LOOKS_S + 1) * 1e6  # a slow machine may be slower
    assert len(seen["within"]) == 1 and seen["within"][0] % PERIOD_US != 0
    assert_same_bytes(RunFolder(tmp_path / "run"), unwatched)
    observe(f"waited, stood still at {seen['paused'][0]} and {seen['within'][0]} us of plant time; the same bytes")


@pytest.mark.fault(
    "a person puts the robot back in the midst of a run",
    injected="RESET by LIMPHOME_PACE, paused, not, and with the controller stopped",
    expected="the controller goes back to where the plant was last put back; the bytes of an undisturbed run",
)
@pytest.mark.parametrize("person", ["put_back", "put_back_unseen"])
def test_a_reset_costs_time_only(tmp_path, unwatched, person, observe):
    seen = inside(run, str(tmp_path), person, [])
    assert seen["exit"] == 0, seen["words"]
    assert "begun anew; back to the end of episode" in seen["words"]
    assert_same_bytes(RunFolder(tmp_path / "run"), unwatched)
    observe("went back and on; the same bytes")


@pytest.mark.fault(
    "a viewer is killed that has paused the plant",
    injected="PAUSE, and nothing more",
    expected="the plant goes on by itself, and the run ends with the bytes of an undisturbed one",
)
def test_a_viewer_that_is_killed_stops_no_run(tmp_path, unwatched, observe):
    seen = inside(run, str(tmp_path), "left_alone", HASTY)
    assert seen["exit"] == 0, seen["words"]
    assert_same_bytes(RunFolder(tmp_path / "run"), unwatched)
    observe("went on; the same bytes")


@pytest.mark.fault(
    "the controller dies while the plant is paused",
    injected="SIGKILL, and another one is started",
    expected="it gets the plant, which stands still at its first state, and learns what an undisturbed run does",
)
def test_a_paused_plant_is_taken_over(tmp_path, unwatched, observe):
    seen = inside(run, str(tmp_path), "taken_over", HASTY)
    assert seen["exit"] == 0, seen["words"]
    assert seen["paused"] == [0]
    assert_same_bytes(RunFolder(tmp_path / "run2"), unwatched)
    observe("taken over at plant time 0; the same bytes")


@pytest.mark.fault(
    "paces that are none",
    injected="not finite, out of range, of an unknown action, too short or too long",
    expected="dropped and counted; the bytes of an undisturbed run",
)
def test_a_pace_that_is_none_is_dropped_and_counted(tmp_path, unwatched, observe):
    seen = inside(run, str(tmp_path), "spoken_to_nonsense", ["learning.episodes=25"])
    assert seen["exit"] == 0, seen["words"]
    assert (seen["non_finite"], seen["malformed"]) == (100, 450)
    rows = [folder.episodes.read_text().splitlines()[1:7] for folder in (RunFolder(tmp_path / "run"), unwatched)]
    assert rows[0] == rows[1]
    observe(f"{seen['malformed']} malformed and {seen['non_finite']} not finite counted; the same rows")
