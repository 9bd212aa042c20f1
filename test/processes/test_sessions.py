"""Whose session it is: several controllers on one bus, copies that come late, states that somebody invented."""

import signal
import time

import pytest
from bus import REAL_TIME, Bus, FakeRobot, controller, inside, simulator
from test_lockstep import clean, learn  # noqa: F401

from limphome import reset_request_t, status_t, velocity_command_t
from limphome_lab.channels import COMMAND, RESET, STATE, STATUS
from limphome_lab.runfolder import RunFolder

GAVE_UP = 3
SHORT = ["learning.episodes=6", "episode.step_limit=40", "episode.reset_every=3", "link.sender_timeout_s=0.5"]


def faults(bus):
    """What controllers told as they gave up."""
    return [status for status in bus.statuses[status_t.CONTROLLER] if status.condition == status_t.FAULT]


def two_controllers(folder):
    """The second comes while the first trains, and is never obeyed."""
    patient = [*SHORT[:-1], "link.sender_timeout_s=2"]  # longer than a machine that does much else stands still
    with Bus(folder) as bus:
        bus.start(simulator(*patient))
        first = bus.start(controller(f"{folder}/first", *patient, "learning.episodes=100000"))
        bus.until(lambda: bus.counts[COMMAND] > 50)
        second = bus.start(controller(f"{folder}/second", *patient, "link.give_up_s=4"))
        bus.until(lambda: not second.running())
        bus.until(lambda: faults(bus), 5)  # told before it ended; the bus may have heard it not yet
        senders = {state.reset_sender for state in bus.states} - {0}
        return {
            "second": second.end(),
            "words": second.words(),
            "owners": len(senders),
            "decisions": [status.decisions for status in faults(bus)[-1:]],
            "first_runs": first.running(),
        }


@pytest.mark.fault(
    "a second controller that is never obeyed",
    injected="two limphome-controllers on one bus",
    expected="the second learns nothing, says so and ends with exit code 3; the first goes on",
)
def test_a_controller_that_is_not_obeyed_ends(tmp_path, observe):
    seen = inside(two_controllers, str(tmp_path))
    observe(f"second: exit {seen['second']}, {seen['decisions']} decisions; owners of all sessions: {seen['owners']}")
    assert seen["first_runs"] and seen["owners"] == 1
    assert seen["second"] == GAVE_UP and seen["decisions"] == [0]
    assert RunFolder(tmp_path / "second").read_episodes() == []
    assert seen["words"].count("does not obey us") == 2  # when it begins, and as the reason at the end


def paused_controller(folder):
    """The first is stopped until the second is obeyed; then it goes on."""
    with Bus(folder) as bus:
        bus.start(simulator(*SHORT))
        first = bus.start(controller(f"{folder}/first", *SHORT, "learning.episodes=100000"))
        bus.until(lambda: bus.counts[COMMAND] > 50)
        second = bus.start(controller(f"{folder}/second", *SHORT, "learning.episodes=30"))
        bus.until(lambda: len(second.words()) > 0, 10)
        first.signal(signal.SIGSTOP)
        owner = bus.state.reset_sender
        taken = bus.until(lambda: bus.state.reset_sender not in (0, owner), 20)
        first.signal(signal.SIGCONT)
        ended = bus.until(lambda: not second.running(), 60)
        after = bus.until(lambda: bus.state.reset_sender == owner, 20)
        return {"taken": bool(taken), "second": second.end() if ended else None, "first_again": bool(after)}


@pytest.mark.fault(
    "two controllers that stop lockstep for ever",
    injected="SIGSTOP of the first until the second is obeyed, then SIGCONT",
    expected="the second trains to its end, then the first is obeyed again",
)
def test_a_pause_hands_the_plant_over_and_back(tmp_path, observe):
    seen = inside(paused_controller, str(tmp_path))
    observe(str(seen))
    assert seen == {"taken": True, "second": 0, "first_again": True}
    assert len(RunFolder(tmp_path / "second").read_episodes()) == 30


@pytest.mark.parametrize(
    "faults, done",
    [
        pytest.param({"ghost": 1.0}, 3, id="a late copy of the last session's state 0"),
        pytest.param({"invent": 0.3}, 20, id="a state with seq 2^63-1"),
        pytest.param({"ahead": 0.3}, 20, id="a state two ahead of its turn"),
        pytest.param({"foreign": 0.5}, 20, id="states of another session behind each of ours"),
    ],
)
@pytest.mark.fault(
    "a state that is not ours changes what is learned, or mutes the controller",
    injected="a plant in lockstep that sends it besides its own states",
    expected="the same policy, byte for byte",
)
def test_states_that_are_not_ours_change_nothing(tmp_path, clean, faults, done, observe):  # noqa: F811
    report, folder = learn(tmp_path / "run", **faults)
    (fault,) = faults
    same = folder.policy.read_bytes() == clean[1].policy.read_bytes()
    observe(f"sent {report['done'][fault]} times; policy {'the same' if same else 'another'}")
    assert report["exit_code"] == 0 and report["differing"] == 0
    assert report["done"][fault] >= done, "the fault was not done"
    assert report["begun"] == clean[0]["begun"]
    assert same and folder.episodes.read_bytes() == clean[1].episodes.read_bytes()


@pytest.mark.fault(
    "the plant has obeyed another",
    injected="a plant in lockstep that goes two states on by itself",
    expected="the controller says so, asks anew and trains to its end",
)
def test_a_plant_that_went_on_alone_is_asked_anew(tmp_path, observe):
    report, folder = learn(tmp_path / "run", leap=1.0, settings=["link.sender_timeout_s=0.3"])
    observe(f"{report['done']['leap']} leaps, {len(report['begun'])} sessions, exit {report['exit_code']}")
    assert report["done"]["leap"] == 1
    assert report["exit_code"] == 0 and len(folder.read_episodes()) == 10
    assert len(report["begun"]) == 5 and "obeyed something else" in report["words"]


def strangers(folder):
    """What a plant does for who does not own its session."""
    seen = {}
    with Bus(folder) as bus:
        bus.start(simulator("link.sender_timeout_s=1"))
        bus.until(lambda: bus.states)
        unowned = bus.state
        bus.command(unowned, 0.0, 0.3)
        bus.listen(0.2)
        seen["moved unasked"] = bus.state.seq
        state = bus.own()
        seen["echoes"] = state.reset_nonce != 0 and state.seq == 0
        stop = time.monotonic() + 1.5
        while time.monotonic() < stop:  # the owner lives; another commands and asks
            bus.ask_for_reset(bus.state, sender=55)
            bus.command(bus.state, 0.0, 0.3, sender=55)
            bus.ask_for_reset(unowned)  # a late copy
            bus.listen(0.02)
            seq = bus.state.seq
            bus.command(bus.state, 0.0, 0.1)
            bus.until(lambda seq=seq: bus.state.seq > seq, 1)
        seen["session kept"] = bus.state.session == state.session
        seen["velocity"] = max(each.actuator_velocity[1] for each in bus.states)
        status = bus.status()
        seen["rejected_sender"], seen["rejected_session"] = status.rejected_sender, status.rejected_session
        bus.listen(1.2)  # silence of the owner
        seen["granted after silence"] = bus.own(sender=55).reset_sender == 55
    return seen


@pytest.mark.fault(
    "commands and resets of who does not own the session",
    injected="a stranger that commands and asks for resets all the time, copies of old requests",
    expected="dropped and counted while the owner lives; the session is the stranger's once it is silent",
)
def test_a_plant_obeys_the_owner_alone(tmp_path, observe):
    seen = inside(strangers, str(tmp_path))
    observe(str(seen))
    assert seen["moved unasked"] == 0 and seen["echoes"] and seen["session kept"] and seen["granted after silence"]
    assert 0.05 < seen["velocity"] < 0.2, "the stranger's 0.3 m/s were obeyed, or the owner's 0.1 not"
    assert seen["rejected_sender"] > 10 and seen["rejected_session"] > 5


def invented_in_real_time(folder):
    with Bus(folder) as bus:
        bus.start(simulator(*REAL_TIME))
        bus.start(controller(f"{folder}/run", *REAL_TIME))
        bus.answer = bus.keep_armed
        bus.until(lambda: bus.counts[COMMAND] > 10)
        invented = bus.state
        bus.answer = None
        for _ in range(3):
            invented.seq = 2**63 - 1
            bus.say(STATE, invented)
            bus.states.pop()
        bus.answer = bus.keep_armed
        commands = bus.counts[COMMAND]
        bus.listen(2)
        status = bus.status(status_t.CONTROLLER)
        return {"commands": bus.counts[COMMAND] - commands, "rejected_ahead": status.rejected_ahead}


@pytest.mark.fault(
    "one invented state mutes a controller in real time",
    injected="three states of its session with seq 2^63-1",
    expected="dropped and counted; each state that follows is answered",
)
def test_a_jump_is_bounded_by_the_time_that_passed(tmp_path, observe):
    seen = inside(invented_in_real_time, str(tmp_path))
    observe(str(seen))
    assert seen["commands"] >= 15 and seen["rejected_ahead"] == 3


def wrong_fault(folder):
    """Somebody tells of a fault that there was not."""
    with Bus(folder) as bus:
        bus.start(simulator(*SHORT))
        run = bus.start(controller(f"{folder}/run", *SHORT, "learning.episodes=20"))
        bus.until(lambda: bus.counts[COMMAND] > 50)
        for _ in range(5):
            status = status_t()
            status.process, status.condition, status.session = status_t.PLANT, status_t.FAULT, bus.state.session
            bus.lcm.publish(STATUS, status.encode())
            robot = FakeRobot()
            bus.say(STATE, robot.state(seq=3))
            bus.listen(0.1)
        return {"ended": bus.until(lambda: not run.running(), 60), "exit": run.end(), "resets": bus.counts[RESET]}


@pytest.mark.fault(
    "a fault that there was not",
    injected="a FAULT in the plant's name and a stranger's state, five times",
    expected="the run comes to its end",
)
def test_a_fault_that_there_was_not_does_not_stop_a_run(tmp_path, observe):
    seen = inside(wrong_fault, str(tmp_path))
    observe(str(seen))
    assert seen["ended"] and seen["exit"] == 0
    assert len(RunFolder(tmp_path / "run").read_episodes()) == 20


def test_requests_without_a_sender_are_refused(tmp_path):
    assert inside(anonymous, str(tmp_path)) >= 2


def anonymous(folder):
    with Bus(folder) as bus:
        bus.start(simulator())
        bus.until(lambda: bus.states)
        request = reset_request_t()
        request.session = bus.state.session
        bus.say(RESET, request)
        request.sender = 5
        bus.say(RESET, request)
        bus.say(COMMAND, velocity_command_t())
        bus.status()  # may have been under way before
        return bus.status().rejected_malformed
