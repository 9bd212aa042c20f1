"""A plant of a few lines that mistreats its link: python fake_plant.py FAULTS URL COMMAND...

Starts COMMAND, a limphome-controller, and answers it in lockstep until it ends. FAULTS is JSON with the probabilities
of what befalls a message: drop, duplicate, reorder (an earlier state comes again), garbage (a broken copy comes too),
ghost (state 0 of the session before comes when one begins), invent, ahead (of our session, with seq 2^63-1, or two
ahead of its turn), foreign (states of another session), leap (once, the robot goes on by itself); and `seed`.

Prints JSON: the controller's exit code, how many states it answered, how often a command for one (session, seq)
differed from an earlier one, the episodes that resets were for, how often each fault was done, how much of the garbage
the controller must have met: what went out before a state that it answered; and what it said.

The robot is a point that the right crawler pushes and the swing joint steers.
"""

import json
import math
import random
import subprocess
import sys
import tempfile
from collections import Counter

import lcm

from limphome import reset_request_t, robot_state_t, velocity_command_t
from limphome_lab.channels import COMMAND, RESET, STATE

LEFT, RIGHT, SWING, BOOM, ARM = range(5)  # actuators
JOINTS = (SWING, BOOM, ARM)
PERIOD_S = 0.5
RESEND_MS = 3
SLOPE = 0.15  # carries the robot ahead [m/s], so that some episodes reach the goal
HOME = [0.0, 0.0, 0.0, 0.6, -1.5]  # of the five actuators, as all lists here
JOINT_LOW = [0, 0, -2.6, -0.6, -2.4]
JOINT_HIGH = [0, 0, 2.6, 1.2, 0.0]


class FakePlant:
    def __init__(self, url, faults):
        self.random = random.Random(faults["seed"])
        self.faults = faults
        self.done = Counter()
        self.lcm = lcm.LCM(url)
        self.lcm.subscribe(COMMAND, self._on_command)
        self.lcm.subscribe(RESET, self._on_reset)
        self.answers = {}  # (session, seq) -> velocities of the first command
        self.differing = 0
        self.earlier = b""
        self.begun = []  # episodes that resets were for
        self.first = self.ghost = b""  # state 0 of this session, and of the one before
        self.heard = False  # the controller: garbage that nobody hears yet would not count
        self.garbage_before_state = self.garbage_met = 0
        self.begin(reset_request_t())

    def begin(self, request):
        """The robot is put back; a new session begins, as `request` asks for."""
        self.owner, self.nonce = request.sender, request.nonce
        self.session = self.random.getrandbits(62)
        self.seq = self.utime = 0
        self.x = self.y = 0.0
        self.heading = math.pi / 2
        self.angles = list(HOME)
        self.command = None
        self.published = False
        self.ghost, self.first = self.first, b""

    def state(self):
        state = robot_state_t()
        state.utime, state.session, state.seq, state.lockstep = self.utime, self.session, self.seq, 1
        state.reset_sender, state.reset_nonce, state.armed = self.owner, self.nonce, 1
        state.num_actuators = len(self.angles)
        state.position = [self.x, self.y, 0.0]
        state.orientation = [math.cos(self.heading / 2), 0.0, 0.0, math.sin(self.heading / 2)]
        state.actuator_position[: len(self.angles)] = self.angles
        state.actuator_effort[RIGHT] = 500.0 * math.sin(self.seq)
        state.actuator_health[LEFT] = 1
        return state

    def advance(self, velocity):
        for joint in JOINTS:
            angle = self.angles[joint] + velocity[joint] * PERIOD_S
            self.angles[joint] = min(max(angle, JOINT_LOW[joint]), JOINT_HIGH[joint])
        self.heading += 0.2 * velocity[RIGHT] * PERIOD_S * (1.0 - self.angles[SWING])
        self.x += (velocity[RIGHT] + SLOPE) * PERIOD_S * math.cos(self.heading)
        self.y += (velocity[RIGHT] + SLOPE) * PERIOD_S * math.sin(self.heading)
        self.utime += round(PERIOD_S * 1e6)
        self.seq += 1
        self.command = None
        self.published = False

    def leap(self):
        """Once, in the midst of a session, two states go by that nobody was told of."""
        if self.seq == 10 and not self.done["leap"] and self.befalls("leap"):
            self.advance([0.0] * 5)
            self.advance([0.0] * 5)

    def befalls(self, fault):
        happens = self.random.random() < self.faults.get(fault, 0.0)
        self.done[fault] += happens
        return happens

    def publish(self):
        state = self.state()
        encoded = state.encode()
        if self.heard and self.befalls("garbage"):
            self.lcm.publish(STATE, encoded[:-3])
            self.lcm.publish(STATE, encoded + b"\0")
            state.position = [math.nan, 0.0, 0.0]
            self.lcm.publish(STATE, state.encode())
        self.first = self.first or encoded
        if self.ghost and self.seq == 0 and not self.published and self.befalls("ghost"):
            self.lcm.publish(STATE, self.ghost)
        if not self.published:
            self.garbage_before_state = self.done["garbage"]
            self.published = True
        if self.befalls("drop"):
            return
        self.lcm.publish(STATE, encoded)
        self.mislead(state)
        if self.befalls("duplicate"):
            self.lcm.publish(STATE, encoded)
        if self.earlier and self.befalls("reorder"):
            self.lcm.publish(STATE, self.earlier)
        if self.befalls("keep"):
            self.earlier = encoded

    def mislead(self, state):
        """Sends states that are not this one after it."""
        for fault, seq in (("invent", 2**63 - 1), ("ahead", state.seq + 2)):
            if self.owner and self.befalls(fault):
                state.seq = seq
                self.lcm.publish(STATE, state.encode())
        if self.befalls("foreign"):
            state.session, state.reset_sender, state.reset_nonce = state.session + 1, 77, 88
            for state.seq in range(5):
                self.lcm.publish(STATE, state.encode())

    def _on_command(self, _channel, data):
        command = velocity_command_t.decode(data)
        key = (command.session, command.seq)
        if key == (self.session, self.seq):
            self.garbage_met = self.garbage_before_state
        first = self.answers.setdefault(key, command.velocity)
        self.differing += first != command.velocity
        if key == (self.session, self.seq) and not self.befalls("drop"):
            self.command = command

    def _on_reset(self, _channel, data):
        self.heard = True
        request = reset_request_t.decode(data)
        if request.session == self.session and not self.befalls("drop"):
            self.begun.append(request.episode)
            self.begin(request)

    def serve(self, controller):
        while controller.poll() is None:
            self.publish()
            while self.lcm.handle_timeout(RESEND_MS):
                if self.command:
                    self.advance(self.command.velocity)
                    self.leap()
                    break


def main():
    faults, url, command = json.loads(sys.argv[1]), sys.argv[2], sys.argv[3:]
    plant = FakePlant(url, {"keep": 0.1, **faults})
    with tempfile.TemporaryFile("w+") as errors:
        controller = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=errors)
        try:
            plant.serve(controller)
        finally:
            controller.kill()
        errors.seek(0)
        words = errors.read()
    print(
        json.dumps(
            {
                "exit_code": controller.wait(),
                "answered": len(plant.answers),
                "differing": plant.differing,
                "done": plant.done,
                "begun": plant.begun,
                "garbage_met": plant.garbage_met,
                "words": words,
            }
        )
    )


if __name__ == "__main__":
    main()
