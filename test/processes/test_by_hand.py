"""A person takes the robot from the learner, drives it joint by joint, and hands it back."""

import os
import pty
import signal
import subprocess
import time

import lcm
import pytest
from bus import FAST, REAL_TIME, Bus, controller, inside, settings, simulator

from conftest import ROOT, TIME_LIMIT_S, train, wait_until
from limphome import decision_t, operate_t, pace_t, pose_t, robot_state_t, status_t
from limphome_lab import network, registry
from limphome_lab.channels import COMMAND, DECISION, EPISODE, OPERATE, PACE, STATE
from limphome_lab.messages import TYPES, recorded
from limphome_lab.run import hand as hand_side
from limphome_lab.run.hand import Hand
from limphome_lab.runfolder import RunFolder

LEFT, RIGHT, SWING, BOOM, ARM = range(5)  # actuators
SOUND = [*REAL_TIME, "failure.actuator=none", "link.operator_timeout_s=1", "link.sender_timeout_s=1"]
STILL = [0] * 5
AHEAD = [1, 1, 0, 0, 0]
OTHER = 7  # an operator


class Operator:
    """Says what it is told to, at each state and in between."""

    def __init__(self, bus, sender=42):
        self.bus, self.sender = bus, sender
        self.directions = None  # nothing is said

    def say(self, action=operate_t.TAKE, directions=STILL, state=None, **fields):
        state = state or self.bus.state
        message = operate_t()
        message.utime, message.sender, message.action = time.monotonic_ns() // 1000, self.sender, action
        message.session, message.seq, message.num_actuators = state.session, state.seq, state.num_actuators
        message.direction[: len(directions)] = directions
        for field, value in fields.items():
            setattr(message, field, value)
        self.bus.say(OPERATE, message)
        return message

    def keep_up(self, state):
        if self.directions is not None:
            self.say(directions=self.directions, state=state)


class Pair:
    """A simulator and a controller in real time, armed, with an operator; what the controller has decided."""

    def __init__(self, folder, *assignments, armed=True):
        self.bus = Bus(folder)
        self.run = f"{folder}/run"
        self.bus.keep = (DECISION, COMMAND)
        self.operator = Operator(self.bus)
        self.armed = armed
        self.bus.start(simulator(*SOUND, *assignments))
        self.controller = self.bus.start(controller(self.run, *SOUND, *assignments))
        self.bus.answer = self.answer

    def __enter__(self):
        self.bus.__enter__()
        if self.armed:
            assert self.bus.until(lambda: self.decided() > 2), self.controller.words()
        return self

    def __exit__(self, *error):
        self.bus.__exit__(*error)

    def answer(self, state):
        if self.armed:
            self.bus.keep_armed(state)
        self.operator.keep_up(state)

    def decided(self):
        return len(self.messages(DECISION))

    def messages(self, channel):
        return [TYPES[channel].decode(data) for heard, data in self.bus.heard if heard == channel]

    def until_in_charge(self, who):
        """Waits for the first decision of `who`; whether it came."""
        known = self.decided()
        return bool(self.bus.until(lambda: any(d.in_charge == who for d in self.messages(DECISION)[known:]), 5))

    def status(self):
        return self.bus.status(status_t.CONTROLLER)


def stroke(velocities):
    """What an actuator did at most in one of those commands."""
    return max(map(abs, velocities), default=0.0)


def take_drive_and_give(folder):
    with Pair(folder) as pair:
        bus, operator = pair.bus, pair.operator
        operator.directions = AHEAD
        assert pair.until_in_charge(decision_t.OPERATOR), pair.controller.words()
        begin = bus.state
        bus.listen(2)
        ahead = bus.state.position[1] - begin.position[1]
        operator.directions = [0, 0, 1, 0, 0]
        bus.listen(1)
        swing = bus.state.actuator_velocity[SWING]
        operator.directions = None
        operator.say(operate_t.GIVE)
        assert pair.until_in_charge(decision_t.LEARNER)
        decisions = pair.messages(DECISION)
        given = next(k for k in reversed(range(len(decisions))) if decisions[k].in_charge == decision_t.OPERATOR) + 1
        bus.listen(1)
        status = pair.status()
        return {
            "ahead": ahead,
            "swing": swing,
            "first": [decisions[given].step, decisions[given].episode, decisions[given].goal_distance],
            "learned": sum(d.learned for d in decisions if d.in_charge == decision_t.OPERATOR),
            "senders": sorted({d.operator_sender for d in decisions}),
            "operated": status.operated,
            "in_charge": status.in_charge,
            "words": pair.controller.words().splitlines()[-2:],
        }


def test_a_person_takes_the_robot_drives_it_and_gives_it_back(tmp_path):
    seen = inside(take_drive_and_give, str(tmp_path))
    assert seen["ahead"] > 0.4 and seen["swing"] > 0.2
    assert seen["first"] == pytest.approx([0, 1, 2.0])  # an episode that begins where the robot stands
    assert seen["learned"] == 0 and seen["senders"] == [0, 42] and seen["in_charge"] == decision_t.LEARNER
    assert seen["words"] == [
        "an operator has taken the robot by hand",
        "the learner goes on from where the robot is",
    ]
    operated = [message for _, message in recorded(tmp_path / "run" / "messages.lcmlog", OPERATE)]
    assert 0 < len(operated) <= seen["operated"] and operated[-1].action == operate_t.GIVE


def silence(folder, then):
    with Pair(folder, "link.give_up_s=1") as pair:
        bus, operator = pair.bus, pair.operator
        operator.directions = AHEAD
        assert pair.until_in_charge(decision_t.OPERATOR)
        bus.listen(1)
        driven = bus.state.actuator_velocity[RIGHT]
        operator.directions = None
        assert pair.until_in_charge(decision_t.NOBODY), pair.controller.words()
        bus.listen(1)
        known = len(bus.states)
        bus.listen(1.5)
        speed = stroke(v for state in bus.states[known:] for v in state.actuator_velocity[:5])
        status = pair.status()
        pair.operator = Operator(bus, sender=OTHER)
        if then == "give":
            pair.operator.say(operate_t.GIVE)
        else:
            pair.operator.directions = AHEAD
        goes_on = pair.until_in_charge(decision_t.LEARNER if then == "give" else decision_t.OPERATOR)
        return {
            "driven": driven,
            "speed": speed,
            "told": [status.condition, status.reason, status.in_charge],
            "goes_on": goes_on,
            "running": pair.controller.running(),
        }


@pytest.mark.parametrize("then", ["give", "take"])
@pytest.mark.fault(
    "the laptop of who drives a robot in real time dies",
    injected="a driving operator who falls silent, while the plant is kept armed",
    expected="the robot stands still, nobody drives it and that is told, until another takes it or gives it",
)
def test_a_robot_that_is_nobodys_stands_still(tmp_path, then, observe):
    seen = inside(silence, str(tmp_path), then)
    observe(str(seen))
    assert seen["driven"] > 0.2 and seen["speed"] < 0.02 and seen["goes_on"] and seen["running"]
    assert seen["told"] == [status_t.WAITING, status_t.OPERATOR_SILENT, decision_t.NOBODY]


def others(folder):
    """Everything that must not take the robot from who has it, nor give it away."""
    with Pair(folder) as pair:
        bus, operator, other = pair.bus, pair.operator, Operator(pair.bus, OTHER)
        operator.directions = STILL
        assert pair.until_in_charge(decision_t.OPERATOR)
        before, known = pair.status(), pair.decided()
        for _ in range(10):
            for action in (operate_t.TAKE, operate_t.GIVE):
                other.say(action, AHEAD)
                operator.say(action, AHEAD, session=bus.state.session + 1)
                operator.say(action, AHEAD, seq=bus.state.seq - 11)
                operator.say(action, AHEAD, seq=bus.state.seq + 5)
                operator.say(action, AHEAD, utime=1)
                operator.say(action, AHEAD, num_actuators=4)
            operator.say(2, AHEAD)
            operator.say(operate_t.TAKE, [2])
            bus.lcm.publish(OPERATE, b"no message")
            bus.listen(0.1)
        bus.listen(0.3)
        after = pair.status()
        counters = ("operate_denied", "operate_stale", "operate_repeated", "operate_malformed", "rejected_malformed")
        return {
            "counts": {name: getattr(after, name) - getattr(before, name) for name in counters},
            "moved": sum(any(command.velocity) for command in pair.messages(COMMAND)[-10:]),
            "senders": sorted({d.operator_sender for d in pair.messages(DECISION)[known:]}),
            "reason": after.reason,
        }


@pytest.mark.fault(
    "a second operator, and messages that no operator has said just now",
    injected="TAKE and GIVE of another; with the echo of another session, of a state long past or to come; sent before "
    "the newest; of another length, count, action or direction",
    expected="who has the robot keeps it, still; each refused and counted",
)
def test_who_has_the_robot_keeps_it(tmp_path, observe):
    seen = inside(others, str(tmp_path))
    observe(str(seen))
    assert seen["moved"] == 0 and seen["senders"] == [42] and seen["reason"] == status_t.NONE
    assert seen["counts"] == {
        "operate_denied": 20,
        "operate_stale": 60,
        "operate_repeated": 20,
        "operate_malformed": 50,
        "rejected_malformed": 0,
    }


def replay(folder):
    """All that an operator said is said again, while the learner drives."""
    with Pair(folder) as pair:
        bus, operator = pair.bus, pair.operator
        bus.keep = (DECISION, OPERATE)
        operator.directions = AHEAD
        assert pair.until_in_charge(decision_t.OPERATOR)
        bus.listen(1)
        operator.directions = None
        operator.say(operate_t.GIVE)
        assert pair.until_in_charge(decision_t.LEARNER)
        spoken, before, known = [data for heard, data in bus.heard if heard == OPERATE], pair.status(), pair.decided()
        for data in spoken:
            bus.lcm.publish(OPERATE, data)
            bus.listen(0.05)
        after = pair.status()
        return {
            "messages": len(spoken),
            "refused": after.operate_stale + after.operate_repeated - before.operate_stale - before.operate_repeated,
            "in_charge": sorted({d.in_charge for d in pair.messages(DECISION)[known:]}),
        }


@pytest.mark.fault(
    "what an operator has said is played back",
    injected="all his messages once more, right after he has given the robot back",
    expected="the learner goes on; each refused and counted",
)
def test_a_recording_takes_no_robot(tmp_path, observe):
    seen = inside(replay, str(tmp_path))
    observe(str(seen))
    assert seen["messages"] > 8 and seen["refused"] == seen["messages"]
    assert seen["in_charge"] == [decision_t.LEARNER]


def not_armed(folder):
    with Pair(folder, armed=False) as pair:
        bus, operator = pair.bus, pair.operator
        operator.directions = AHEAD
        bus.until(lambda: bus.statuses[status_t.CONTROLLER] and pair.status().in_charge == decision_t.OPERATOR, 10)
        bus.listen(1)
        commands = pair.messages(COMMAND)
        speed = stroke(v for state in bus.states for v in state.actuator_velocity[:5])
        status = pair.status()
        pair.armed = True
        moves = bus.until(lambda: bus.state.actuator_velocity[RIGHT] > 0.2, 5)
        return {
            "commands": len(commands),
            "moving": sum(any(command.velocity) for command in commands),
            "speed": speed,
            "told": [status.reason, status.in_charge],
            "moves": bool(moves),
        }


@pytest.mark.fault(
    "a robot by hand that is not armed",
    injected="an operator who drives, on a plant that nobody has armed",
    expected="at rest, until it is armed",
)
def test_by_hand_it_moves_once_it_is_armed(tmp_path, observe):
    seen = inside(not_armed, str(tmp_path))
    observe(str(seen))
    assert seen["commands"] > 5 and seen["moving"] == 0 and seen["speed"] < 0.02 and seen["moves"]
    assert seen["told"] == [status_t.NOT_ARMED, decision_t.OPERATOR]


def into_the_stop(folder):
    """Left crawler, which has failed, and boom, to its stop."""
    with Pair(folder, "failure.actuator=left_crawler") as pair:
        bus, operator = pair.bus, pair.operator
        operator.directions = [1, 0, 0, 1, 0]
        assert pair.until_in_charge(decision_t.OPERATOR)
        known = pair.decided()
        stilled = bus.until(lambda: pair.messages(DECISION)[-1].interventions & decision_t.STOP, 10)
        bus.listen(0.5)
        commands = pair.messages(COMMAND)[known:]
        return {
            "stilled": stilled,
            "boom": bus.state.actuator_position[BOOM],
            "left": stroke(command.velocity[LEFT] for command in commands),
            "end": stroke(command.velocity[BOOM] for command in commands[-3:]),
            "proposed": pair.messages(DECISION)[-1].proposed_action,
        }


@pytest.mark.fault(
    "a person who drives a joint into its stop, and a crawler that has failed",
    injected="the boom held up, and the locked crawler ahead, on the simulator in real time",
    expected="the monitor stills the boom at its stop of 1.2 rad; the crawler is not commanded",
)
def test_the_monitor_stills_a_person(tmp_path, observe):
    seen = inside(into_the_stop, str(tmp_path))
    observe(str(seen))
    assert seen["stilled"] == decision_t.STOP and 1.1 < seen["boom"] < 1.201 and seen["end"] == seen["left"] == 0
    assert seen["proposed"] == 1 + 3 + 9 * 2 + 27  # right crawler, swing, boom, arm


def in_lockstep(folder):
    """A training pair that a person slows down to the pace of the clock, drives, and leaves without a word."""
    assignments = [*FAST, "link.operator_timeout_s=1", "learning.episodes=100000"]
    said = []
    with Bus(folder) as bus, Hand(network.lcm_url(), said.append) as hand:
        bus.start(simulator(*assignments))
        run = bus.start(controller(f"{folder}/run", *assignments))
        assert bus.until(lambda: bus.counts[DECISION] > 300), run.words()
        pace = pace_t()
        pace.action, pace.pace = pace_t.RUN, 1.0
        bus.say(PACE, pace)
        bus.listen(0.5)

        def attend():
            bus.listen(0.05)
            hand.answer()
            return hand.in_charge

        hand.take()
        assert bus.until(lambda: attend() == hand_side.ME, 5), run.words()
        hand.drive(AHEAD)
        begin = bus.state
        bus.until(lambda: attend() != hand_side.ME, 2)
        driven = [hand.decision.in_charge, bus.state.actuator_position[RIGHT] - begin.actuator_position[RIGHT]]
        same = begin.session == bus.state.session
        pace.pace = pose_t.PACE_FREE
        bus.say(PACE, pace)
        known = bus.counts[EPISODE]
        goes_on = bus.until(lambda: bus.counts[EPISODE] > known + 5)
        status = bus.status(status_t.CONTROLLER)
        hand.answer()
        return {
            "driven": driven,
            "same": same,
            "goes_on": bool(goes_on),
            "in_charge": status.in_charge,
            "said": said,
            "exit": run.end(),
        }


@pytest.mark.fault(
    "the window of who drives a training pair by hand is closed",
    injected="a pair in lockstep at the pace of the clock, an operator who drives and then is silent",
    expected="the learner goes on after link.operator_timeout_s, as nothing can come to harm",
)
def test_in_lockstep_the_learner_goes_on_after_a_silence(tmp_path, observe):
    seen = inside(in_lockstep, str(tmp_path))
    observe(str(seen))
    in_charge, way = seen["driven"]
    assert in_charge == decision_t.OPERATOR and seen["same"] and 0.3 < way < 0.7
    assert seen["goes_on"] and seen["in_charge"] == decision_t.LEARNER and seen["exit"] == 130
    assert seen["said"][-2:] == [hand_side.WORDS[hand_side.ME], hand_side.WORDS[hand_side.LEARNER]]


def test_log_time_is_plant_time(tmp_path):
    """Of each event that of the newest state, and never back; sessions are laid one after the other."""
    train(tmp_path / "run", "--episodes", 12, "--set", "episode.reset_every=4")
    log = lcm.EventLog(str(RunFolder(tmp_path / "run").messages))
    begins, newest, last, sessions = 0, 0, 0, []
    for event in log:
        assert event.timestamp >= last
        last = event.timestamp
        if event.channel == STATE:
            state = robot_state_t.decode(event.data)
            if state.session not in sessions:
                sessions.append(state.session)
                begins, newest = begins + newest, 0
            newest = state.utime
            assert event.timestamp == begins + newest
    assert len(sessions) == 3 and last > 10e6


@pytest.fixture
def terminal():
    """(what types, what is typed at)"""
    ends = pty.openpty()
    yield ends
    for end in ends:
        os.close(end)


def test_launch_is_driven_by_keys(tmp_path, monkeypatch, terminal):
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    keyboard, stdin = terminal
    launch = subprocess.Popen(
        [ROOT / "scripts" / "launch", *settings(*FAST, "failure.actuator=none", "learner.kind=q_learning"), "--arm"],
        start_new_session=True,
        stdin=stdin,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        wait_until(launch, registry.running)
        folder = RunFolder(registry.running()[0]["run"])

        def says(words):
            log = folder.path / "controller.log"
            return log.exists() and words in log.read_text()

        wait_until(launch, folder.messages.exists)
        time.sleep(2)
        os.write(keyboard, b"h")
        wait_until(launch, lambda: says("taken the robot by hand"))
        for _ in range(10):
            os.write(keyboard, b"2q")  # the right crawler ahead, the left one back
            time.sleep(0.2)
        time.sleep(1.5)  # the keys are up
        os.write(keyboard, b"l")
        wait_until(launch, lambda: says("the learner goes on"))
    finally:
        launch.send_signal(signal.SIGINT)
        errors = launch.communicate(timeout=TIME_LIMIT_S)[1]
    assert launch.returncode == 130, errors
    assert "2/w right_crawler" in errors
    decisions = [message for _, message in recorded(folder.messages, DECISION)]
    by_hand = [decision.action for decision in decisions if decision.in_charge == decision_t.OPERATOR]
    still = (3**5 - 1) // 2
    turning = still - 3**LEFT + 3**RIGHT
    assert by_hand.count(turning) > 10 and by_hand[-5:] == [still] * 5 and decisions[-1].in_charge == decision_t.LEARNER
