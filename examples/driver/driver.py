"""A plant in real time on the messages alone, as in any language: driver.py --config FILE --lcm-url URL

FILE is the resolved config.ini of a run folder, as scripts/launch --driver gives it. docs/protocol.md tells the rules.
Left out: the status, by which a plant tells why it is not armed, and its counters.
"""

import argparse
import configparser
import math
import os
import time

import lcm

from limphome import arm_request_t, reset_request_t, robot_state_t, velocity_command_t
from limphome_lab.channels import ARM, COMMAND, RESET, STATE

SLICE_S, RAMP_S = 0.01, 0.5  # how often the motors are told; from the last command obeyed to rest


class Robot:
    """Yours takes its place; this one does at once what it is told. Left and right crawler, swing, boom, arm."""

    def __init__(self):
        self.position, self.velocity, self.health = [0.0, 0.0, 0.0, 0.6, -1.5], [0.0] * 5, [1, 0, 0, 0, 0]

    def command(self, velocity):
        self.velocity = [0.0 if failed else v for v, failed in zip(velocity, self.health, strict=True)]
        self.position = [p + v * SLICE_S for p, v in zip(self.position, self.velocity, strict=True)]

    def sense(self, state):
        state.orientation = [math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)]  # body to world: level, facing +y
        state.position = [0.0, self.position[1], 0.0]  # not measured: as far as the belt that obeys
        for field in ("position", "velocity", "health"):
            setattr(state, f"actuator_{field}", [*getattr(self, field), *[0] * 3])


class Plant:
    def __init__(self, robot, url, config):
        self.robot, self.bus, self.count = robot, lcm.LCM(url), len(robot.position)
        link, action = config["link"], config["action"]
        self.speed = [float(action["crawler_speed"])] * 2 + [float(action["joint_speed"])] * (self.count - 2)
        self.late, self.silent = float(link["command_timeout_s"]), float(link["sender_timeout_s"])
        self.unkept, self.period = float(link["operator_timeout_s"]), float(config["episode"]["decision_period_s"])
        self.owner, self.owner_heard, self.armed, self.operator, self.operator_heard = 0, -math.inf, False, 0, 0.0
        handlers = {
            COMMAND: (velocity_command_t, self.on_command),
            RESET: (reset_request_t, self.on_reset),
            ARM: (arm_request_t, self.on_arm),
        }
        for channel, (kind, handler) in handlers.items():
            self.bus.subscribe(channel, lambda _, data, k=kind, h=handler: self.hear(k, data, h))
        self.begin(0, 0)

    def hear(self, kind, data, handler):
        try:  # the bus is open to all
            message = kind.decode(data)
        except Exception:
            return
        if message.encode() == data:  # nothing behind it
            handler(message, time.monotonic())

    def begin(self, sender, nonce):
        """A session: obeys nobody but who asked for it. The robot stays where it is."""
        self.session, self.sender, self.nonce, self.seq, self.sent = random(), sender, nonce, -1, {}
        self.obeyed, self.born, self.velocity, self.held = -1, -math.inf, [0.0] * self.count, True
        self.publish()

    def publish(self):
        state, now = robot_state_t(), time.monotonic()
        self.seq, self.challenge, self.due = self.seq + 1, random(), now + self.period
        self.sent = {seq: at for seq, at in self.sent.items() if now - at[0] <= self.late} | {
            self.seq: (now, self.armed)
        }
        state.utime = state.sent = int(now * 1e6)
        state.session, state.seq, state.reset_sender, state.reset_nonce = (
            self.session,
            self.seq,
            self.sender,
            self.nonce,
        )
        state.reset, state.armed, state.challenge = robot_state_t.WHERE_IT_IS, self.armed, self.challenge
        state.num_actuators, state.held, self.held = self.count, self.held, False
        self.robot.sense(state)
        self.bus.publish(STATE, state.encode())

    def on_reset(self, request, now):
        if request.session == self.session and request.sender != 0 and request.nonce != 0:
            if request.sender != self.owner and now - self.owner_heard < self.silent:
                return  # another controller has it
            self.armed = self.armed and request.sender == self.owner
            self.owner, self.owner_heard = request.sender, now
            self.begin(request.sender, request.nonce)

    def on_command(self, command, now):
        velocity = command.velocity[: self.count]
        ours = command.session == self.session and command.sender == self.sender != 0
        if not ours or command.num_actuators != self.count or not all(map(math.isfinite, velocity)):
            return
        at, armed = self.sent.get(command.seq, (-math.inf, False))
        if now - at <= self.late:
            self.owner_heard = now
            if armed and command.seq > self.obeyed:
                self.obeyed, self.born = command.seq, at
                self.velocity = [min(max(v, -most), most) for v, most in zip(velocity, self.speed, strict=True)]

    def on_arm(self, request, now):
        keeps = request.action == arm_request_t.KEEP and self.armed and request.sender == self.operator
        if request.action == arm_request_t.DISARM:
            self.armed = False
        elif request.challenge == self.challenge and (keeps or request.action == arm_request_t.ARM) and self.sender:
            self.velocity = self.velocity if self.armed else [0.0] * self.count  # of before: says nothing of now
            self.armed, self.operator, self.operator_heard, self.challenge = True, request.sender, now, random()

    def drive(self):
        """One slice of time: what the motors are told, and whether the plant stays armed."""
        now = time.monotonic()
        self.armed = self.armed and now - self.owner_heard < self.silent and now - self.operator_heard < self.unkept
        if not self.armed:
            self.born = min(self.born, now - self.late)  # ramps to rest from now on
        share = min(max(1 - (now - self.born - self.late) / RAMP_S, 0.0), 1.0)
        self.held = self.held or share < 1
        self.robot.command([v * share for v in self.velocity])


def random():
    return int.from_bytes(os.urandom(7), "big") + 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for option in ("--config", "--lcm-url", "--robot"):
        parser.add_argument(option)
    args = parser.parse_args()
    config = configparser.ConfigParser()
    config.read(args.config)
    robot = Robot()
    plant = Plant(robot, args.lcm_url, config)
    next_slice = time.monotonic()
    try:
        while True:
            next_slice += SLICE_S
            while (left := next_slice - time.monotonic()) > 0:
                plant.bus.handle_timeout(math.ceil(left * 1000))
            plant.drive()
            if time.monotonic() >= plant.due:
                plant.held = plant.held or plant.obeyed != plant.seq
                plant.publish()
    finally:
        robot.command([0.0] * plant.count)


if __name__ == "__main__":
    main()
