"""A controller that gets nothing to decide on, or far too much: it says so, goes on when it can, and ends where there
is no use."""

import math
import signal
import sys
import time

import pytest
from bus import REAL_TIME, Bus, FakeRobot, controller, inside, simulator

from limphome import arm_request_t, reset_request_t, status_t, velocity_command_t
from limphome_lab.channels import ARM, COMMAND, DECISION, OPERATE, RESET, STATE, STATUS
from limphome_lab.messages import TYPES, recorded
from limphome_lab.runfolder import RunFolder

GAVE_UP = 3
SOON = ["link.give_up_s=2", "link.sender_timeout_s=0.5"]
SHORT = ["learning.episodes=6", "episode.step_limit=40", "episode.reset_every=3"]


def alone(folder):
    with Bus(folder) as bus:
        run = bus.start(controller(f"{folder}/run", *SOON))
        bus.until(lambda: not run.running(), 20)
        statuses = bus.statuses[status_t.CONTROLLER]
        return {"exit": run.end(), "words": run.words(), "reasons": sorted({each.reason for each in statuses})}


@pytest.mark.fault(
    "no plant",
    injected="a controller alone on the bus",
    expected="it says so once, WAITING with the reason, and ends with exit code 3 after [link] give_up_s",
)
def test_no_plant(tmp_path, observe):
    seen = inside(alone, str(tmp_path))
    observe(f"exit {seen['exit']}: {seen['words'].splitlines()[-1]}")
    assert seen["exit"] == GAVE_UP and status_t.NO_PLANT in seen["reasons"]
    assert len(seen["words"].splitlines()) == 2 and "given up after 2 s: no plant" in seen["words"]


def hung_plant(folder, goes_on):
    """A plant in lockstep that is stopped in the midst of a run, for 3 s or for ever."""
    with Bus(folder) as bus:
        plant = bus.start(simulator(*SHORT))
        give_up = "link.give_up_s=60" if goes_on else "link.give_up_s=2"
        run = bus.start(controller(f"{folder}/run", *SHORT, "link.sender_timeout_s=0.5", give_up))
        bus.until(lambda: bus.counts[DECISION] > 60)
        plant.signal(signal.SIGSTOP)
        bus.listen(3)
        reasons = sorted({each.reason for each in bus.statuses[status_t.CONTROLLER]})
        if goes_on:
            plant.signal(signal.SIGCONT)
        bus.until(lambda: not run.running(), 60)
        return {"exit": run.end(), "words": run.words(), "reasons": reasons}


@pytest.mark.fault(
    "a plant that hangs",
    injected="SIGSTOP of the plant in lockstep, for ever",
    expected="the controller says so, WAITING with the reason, and ends with exit code 3",
)
def test_a_plant_that_hangs(tmp_path, observe):
    seen = inside(hung_plant, str(tmp_path), False)
    observe(f"exit {seen['exit']}: {seen['words'].splitlines()[-1]}")
    assert seen["exit"] == GAVE_UP and status_t.PLANT_SILENT in seen["reasons"]
    assert "given up after 2 s: the plant has fallen silent" in seen["words"]


def unbroken(folder):
    with Bus(folder) as bus:
        bus.start(simulator(*SHORT))
        run = bus.start(controller(f"{folder}/run", *SHORT))
        bus.until(lambda: not run.running(), 60)
        return run.end()


@pytest.mark.fault(
    "a plant that hangs for a while",
    injected="SIGSTOP of the plant in lockstep for 3 s, SIGCONT",
    expected="the run comes to its end with the policy of an unbroken one",
)
def test_a_plant_that_hangs_for_a_while(tmp_path, observe):
    for name in ("unbroken", "stopped"):
        (tmp_path / name).mkdir()
    seen = inside(hung_plant, str(tmp_path / "stopped"), True)
    assert inside(unbroken, str(tmp_path / "unbroken")) == 0
    policies = [RunFolder(tmp_path / name / "run").policy.read_bytes() for name in ("unbroken", "stopped")]
    observe(f"exit {seen['exit']}, policy {'the same' if policies[0] == policies[1] else 'another'}")
    assert seen["exit"] == 0 and status_t.PLANT_SILENT in seen["reasons"]
    assert policies[0] == policies[1]


BROKEN = {
    "NaN": {"position": [math.nan, 0.0, 0.0]},
    "no attitude": {"orientation": [0.0, 0.0, 0.0, 0.0]},
    "no actuators": {"num_actuators": 0},
}


def broken_plant(folder, what):
    """A plant in lockstep, all of whose states are broken but the first few; some 2,000 a second."""
    with Bus(folder) as bus:
        robot = FakeRobot()
        bus.keep = (COMMAND, RESET)
        run = bus.start(controller(f"{folder}/run", "link.give_up_s=3", "link.sender_timeout_s=0.5"))
        sent = 0
        while run.running() and sent < 100_000:
            broken = BROKEN[what] if robot.owner and robot.seq >= 5 else {}
            for _ in range(10 if broken else 1):
                bus.say(STATE, robot.state(**broken))
                sent += 1
            bus.listen(0.005)
            for channel, data in bus.heard:
                if channel == RESET and not robot.owner:
                    robot.begin(reset_request_t.decode(data))
                elif channel == COMMAND:
                    robot.seq = velocity_command_t.decode(data).seq + 1
            bus.heard.clear()
        status = bus.statuses[status_t.CONTROLLER]
        return {
            "exit": run.end(),
            "sent": sent,
            "bytes": len(run.words()),
            "lines": run.words().splitlines(),
            "faults": sum(each.condition == status_t.FAULT for each in status[:-1]),
            "reason": status[-1].reason,
        }


@pytest.mark.parametrize("what", BROKEN)
@pytest.mark.fault(
    "invalid states without end",
    injected="a plant in lockstep that sends some 2,000 of them a second",
    expected="FAULT with the reason, a line a second at most, exit code 3 after [link] give_up_s",
)
def test_invalid_states_for_ever(tmp_path, what, observe):
    seen = inside(broken_plant, str(tmp_path), what)
    observe(f"exit {seen['exit']}, {seen['sent']} states, {seen['bytes']} bytes said: {seen['lines'][-1]}")
    assert seen["exit"] == GAVE_UP and seen["sent"] > 500
    assert seen["bytes"] < 1000 and len(seen["lines"]) <= 7
    assert seen["faults"] >= 1 and seen["reason"] == status_t.INVALID_STATES


# Copies of one message as fast as they can be sent.
FLOODER = """
import socket, struct, sys
channel, data = sys.argv[1].encode(), bytes.fromhex(sys.argv[2])
out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
out.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
out.connect(("239.255.76.67", 7667))
packet = struct.pack(">II", 0x4C433032, 0) + channel + b"\\0" + data
while True:
    for _ in range(100):
        out.send(packet)
"""


def flooded(folder, channel, pace):
    """When a flood was there, by the monotonic clock [us]. What came of it the controller's log tells, as our own ears
    are too full then."""
    options = [*REAL_TIME, "link.operator_timeout_s=60"] if pace == "real_time" else []
    with Bus(folder) as bus:
        bus.start(simulator(*options))
        bus.start(controller(f"{folder}/run", *options, "learning.episodes=100000"))
        if pace == "real_time":
            bus.answer = bus.keep_armed
        assert bus.until(lambda: bus.counts[DECISION] > 10), "nothing is decided"
        message = TYPES[channel]()
        if channel == STATE:
            message = FakeRobot().state(lockstep=bus.state.lockstep)
        if channel == ARM:
            message.action = arm_request_t.ARM  # with a wrong challenge; a DISARM would be heeded
        times = [monotonic_us()]
        bus.listen(2.2)
        times.append(monotonic_us())
        flood = bus.start([sys.executable, "-c", FLOODER, channel, message.encode().hex()])
        time.sleep(5)
        times.append(monotonic_us())
        flood.signal(signal.SIGKILL)
        return {"times": times, "words": [program.words() for program in bus.programs]}


def monotonic_us():
    return time.monotonic_ns() // 1000


FLOODS = [(channel, "lockstep") for channel in (STATE, COMMAND, RESET, STATUS, OPERATE)] + [(ARM, "real_time")]


@pytest.mark.parametrize("channel, pace", [*FLOODS, (STATE, "real_time"), (COMMAND, "real_time")])
@pytest.mark.fault(
    "a flood of messages",
    injected="one message over and over, as fast as a process can send",
    expected="decisions go on; DEGRADED with the reason where more comes than is looked at",
)
def test_a_flood_costs_time_only(tmp_path, channel, pace, observe):
    seen = inside(flooded, str(tmp_path), channel, pace)
    before, begin, end = seen["times"]
    log = tmp_path / "run" / "messages.lcmlog"
    statuses = [status for _, status in recorded(log, STATUS) if status.wall_time > 0]  # those of the flood have none
    told = [status for status in statuses if begin < status.utime <= end]
    degraded = sum((each.condition, each.reason) == (status_t.DEGRADED, status_t.FLOODED) for each in told)

    def rate(since, until):
        """Decisions a second between the controller's first and last status in a while."""
        of_controller = [
            each for each in statuses if each.process == status_t.CONTROLLER and since < each.utime <= until
        ]
        first, last = of_controller[0], of_controller[-1]
        return (last.decisions - first.decisions) / max(1e-6 * (last.utime - first.utime), 1e-6)

    during = rate(begin, end)
    observe(
        f"{rate(before, begin):.0f} decisions a second before, {during:.0f} during; "
        f"{degraded} of {len(told)} statuses DEGRADED"
    )
    assert during > 1, "decisions do not go on"
    assert degraded > 0
    assert all(len(words) < 1000 for words in seen["words"])
