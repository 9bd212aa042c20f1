"""A person takes the robot from the learner, drives it joint by joint, and hands it back."""

import random
import time

import pytest
from bus import FAST, REAL_TIME, Bus, controller, inside, simulator
from fake_plant import FakePlant

from limphome import decision_t, operate_t, status_t
from limphome_lab import network
from limphome_lab.channels import COMMAND, DECISION, EPISODE, OPERATE, STATE
from limphome_lab.messages import TYPES, recorded
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
        first = next(d for d in reversed(pair.messages(DECISION)) if d.step == 0)
        bus.listen(1)
        status = pair.status()
        return {
            "ahead": ahead,
            "swing": swing,
            "step": first.step,
            "operated": status.operated,
            "in_charge": status.in_charge,
            "words": pair.controller.words(),
        }


def test_a_person_takes_the_robot_drives_it_and_gives_it_back(tmp_path):
    seen = inside(take_drive_and_give, str(tmp_path))
    assert seen["ahead"] > 0.3
