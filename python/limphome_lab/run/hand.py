"""The operator's side of driving by hand, and the keys that a person does it by.

Whoever takes the robot from the learner keeps it for as long as this program keeps it up. Once it is lost, whatever the
reason, it is taken again by a person alone, never by this program of itself.
"""

import contextlib
import os
import time

import lcm

from limphome import decision_t, operate_t, robot_state_t, status_t
from limphome_lab.channels import DECISION, OPERATE, STATE, STATUS

QUEUE = 500  # messages that wait to be looked at; only the newest of each kind counts
HELD_S = 0.7  # a key moves its actuator for so long after it was pressed, as a terminal tells of no release
FORWARD, REVERSE = "12345678", "qwertyui"  # keys of the actuators, in order
TAKE, GIVE = "h", "l"

LEARNER, ME, ANOTHER, NOBODY = "learner", "me", "another", "nobody"
WORDS = {
    LEARNER: "the learner drives",
    ME: "you drive",
    ANOTHER: "another operator drives",
    NOBODY: "the operator was silent: the robot stands still until it is taken, or given to the learner",
}


class Hand:
    """Use as a context. Call `answer` five times a second at least: it keeps up what `take` and `give` ask for. Leaving
    the context lets go: the lease runs out, and the robot stands still, or in lockstep the learner goes on.

    `state`: newest robot_state_t, or None; `decision`: newest decision_t, or None; `in_charge`: who decides, one of
    LEARNER, ME, ANOTHER (operator) and NOBODY, or None while no controller is heard; `wants`: whether it is to be ours.
    """

    def __init__(self, url, say):
        self.say = say
        self.sender = int.from_bytes(os.urandom(8), signed=True) or 1
        self.state = self.decision = self.in_charge = None
        self.wants = self.gives = False
        self.directions = []
        self._had = False  # since it was taken
        self._refused = None  # operate_stale of the newest status
        self.lcm = lcm.LCM(url)
        for channel, hear in ((STATE, self._on_state), (DECISION, self._on_decision), (STATUS, self._on_status)):
            self.lcm.subscribe(channel, hear).set_queue_capacity(QUEUE)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.wants = self.gives = False

    def take(self):
        """The robot is to be driven by hand; it stands still until `drive`."""
        self._had = self._had and self.wants
        self.wants, self.gives, self.directions = True, False, []
        self._send(operate_t.TAKE)

    def drive(self, directions):
        """Wanted of each actuator of the robot from now on: -1 reverse, 0 still, 1 forward; missing ones are still."""
        changed = list(directions) != self.directions
        self.directions = list(directions)
        if self.wants and changed:
            self._send(operate_t.TAKE)

    def give(self):
        """Hands the robot to the learner, also one that nobody has."""
        self.wants, self.gives, self.directions = False, True, []
        self._send(operate_t.GIVE)

    def answer(self):
        """Takes in what has been said, and keeps up what is wanted."""
        for _ in range(3 * QUEUE):  # all of them: those that are left are the oldest
            if not self.lcm.handle_timeout(0):
                break
        if self.wants:
            self._send(operate_t.TAKE)
        elif self.gives:
            self._send(operate_t.GIVE)

    def _send(self, action):
        if self.state is None:
            return
        message = operate_t()
        message.utime, message.sender, message.action = time.monotonic_ns() // 1000, self.sender, action
        message.session, message.seq = self.state.session, self.state.seq
        message.num_actuators = self.state.num_actuators
        for k, direction in enumerate(self.directions[: message.num_actuators]):
            message.direction[k] = direction
        self.lcm.publish(OPERATE, message.encode())

    def _notice(self, message):
        """Whom a decision_t or status_t of the controller tells to be in charge."""
        before = self.in_charge
        if message.in_charge == decision_t.OPERATOR:
            self.in_charge = ME if message.operator_sender == self.sender else ANOTHER
        else:
            self.in_charge = NOBODY if message.in_charge == decision_t.NOBODY else LEARNER
        self._had = self._had or self.in_charge == ME
        self.gives = self.gives and self.in_charge != LEARNER
        if self.in_charge != before:
            self.say(WORDS[self.in_charge])
        if self.wants and (self.in_charge == ANOTHER or (self._had and self.in_charge != ME)):
            self.wants = False  # to go on is for a person to say

    def _on_state(self, _channel, data):
        with contextlib.suppress(ValueError):  # the bus is open to all
            self.state = robot_state_t.decode(data)

    def _on_decision(self, _channel, data):
        with contextlib.suppress(ValueError):
            self.decision = decision_t.decode(data)
            self._notice(self.decision)

    def _on_status(self, _channel, data):
        with contextlib.suppress(ValueError):
            status = status_t.decode(data)
            if status.process != status_t.CONTROLLER:
                return
            self._notice(status)
            refused, self._refused = self._refused, status.operate_stale
            if self.wants and self.in_charge == LEARNER and refused not in (None, self._refused):
                self.say("the plant runs too fast to be driven by hand: let it go at the pace of the clock")


class HandKeys:
    """What a person types, as driving: TAKE and GIVE, and a key for each direction of each actuator."""

    def __init__(self, hand):
        self.hand = hand
        self.moves = {}  # {actuator: (direction, until when [s])}

    def press(self, key, now):
        if key == TAKE:
            self.hand.take()
        elif key == GIVE:
            self.hand.give()
        for direction, keys in ((1, FORWARD), (-1, REVERSE)):
            if key in keys:
                self.moves[keys.index(key)] = (direction, now + HELD_S)

    def stop(self):
        """Of the moves, at once; call `look` then."""
        self.moves = {}

    def look(self, now):
        """Call a few times a second."""
        self.moves = {k: move for k, move in self.moves.items() if move[1] > now}
        self.hand.drive([self.moves.get(k, (0,))[0] for k in range(len(FORWARD))])
        self.hand.answer()


def words(actuators):
    """What the keys do on a robot with these actuators."""
    moves = ", ".join(f"{FORWARD[k]}/{REVERSE[k]} {name}" for k, name in enumerate(actuators))
    return f"{TAKE} takes it by hand, {GIVE} lets it limp home by the learner; hold a key to move, ahead/back: {moves}"
