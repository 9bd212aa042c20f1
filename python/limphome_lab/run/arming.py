"""The operator's side of arming a plant in real time, and the keys that a person does it by.

A plant moves only while an operator answers the challenges in its states. Once it has disarmed, whatever the reason, it
is armed again by a person alone, never by this program of itself.
"""

import contextlib
import os
import select
import signal
import sys
import termios
import time
import tty

import lcm

from limphome import arm_request_t, robot_state_t, status_t
from limphome_lab.channels import ARM, STATE, STATUS

QUEUE = 500  # states that wait to be looked at; only the newest one counts
FAREWELLS = 3  # a message may be lost
ARMS = " \r\n"  # keys that arm and disarm
LFLAG = 3  # index in what tcgetattr gives

REASONS = {
    status_t.NOT_YET_ARMED: "nobody has armed it yet",
    status_t.CONTROLLER_SILENT: "the controller is silent",
    status_t.OPERATOR_SILENT: "the operator was silent",
    status_t.MACHINE_FAILED: "the machine has failed",
    status_t.BY_OPERATOR: "the operator has said so",
}


class Operator:
    """Use as a context: leaving it disarms the plant, whatever happened. Call `answer` a few times a second."""

    def __init__(self, url, say, arm=False):
        self.say = say
        self.sender = int.from_bytes(os.urandom(8), signed=True)
        self.wants_armed = arm
        self.armed = False
        self.state = None  # newest one heard since the last answer
        self.reason = status_t.NONE
        self.lcm = lcm.LCM(url)
        for channel, hear in ((STATE, self._on_state), (STATUS, self._on_status)):
            self.lcm.subscribe(channel, hear).set_queue_capacity(QUEUE)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for _ in range(FAREWELLS):
            self._send(arm_request_t.DISARM)

    def toggle(self):
        """The person has pressed the key."""
        self.wants_armed = not (self.armed or self.wants_armed)
        if not self.wants_armed:
            self._send(arm_request_t.DISARM)

    def answer(self):
        """Takes in what the plant has said and answers its newest challenge, if it is to be armed."""
        for _ in range(QUEUE):
            if not self.lcm.handle_timeout(0):
                break
        if self.state is None:
            return
        self._notice(bool(self.state.armed))
        if self.wants_armed:
            self._send(arm_request_t.KEEP if self.armed else arm_request_t.ARM, self.state.challenge)
        self.state = None

    def _notice(self, armed):
        if armed and not self.armed:
            self.say("armed: the robot moves; space or enter stops it")
        elif self.armed and not armed:
            self.wants_armed = False  # to go on is for a person to say
            self.say("disarmed; space or enter arms it again")
        self.armed = armed

    def _send(self, action, challenge=0):
        request = arm_request_t()
        request.utime = time.monotonic_ns() // 1000
        request.sender, request.challenge, request.action = self.sender, challenge, action
        self.lcm.publish(ARM, request.encode())

    def _on_state(self, _channel, data):
        with contextlib.suppress(ValueError):  # the bus is open to all
            state = robot_state_t.decode(data)
            self.state = None if state.lockstep else state

    def _on_status(self, _channel, data):
        with contextlib.suppress(ValueError):
            status = status_t.decode(data)
            if status.process == status_t.PLANT and status.reason != self.reason:
                self.reason = status.reason
                if self.reason in REASONS:
                    self.say(f"not armed: {REASONS[self.reason]}")


class Keys:
    """Single keys from the terminal while it is a context, and while this process is in the foreground there; none
    where stdin is no terminal."""

    def __enter__(self):
        self.terminal = sys.stdin.fileno() if sys.stdin is not None and sys.stdin.isatty() else None
        self.before = None
        # a process that has gone to the background while it sets the terminal is not to be stopped for it
        self.on_ttou = signal.signal(signal.SIGTTOU, signal.SIG_IGN)
        self._by_keys()
        return self

    def __exit__(self, *_):
        if self.before is not None and self._in_foreground():
            termios.tcsetattr(self.terminal, termios.TCSADRAIN, self.before)
        signal.signal(signal.SIGTTOU, self.on_ttou)

    def typed(self):
        """What was typed since the last call."""
        keys = ""
        while self._by_keys() and select.select([self.terminal], [], [], 0)[0]:
            typed = os.read(self.terminal, 64).decode(errors="replace")
            if not typed:
                break
            keys += typed
        return keys

    def _in_foreground(self):
        try:
            return os.tcgetpgrp(self.terminal) == os.getpgrp()
        except OSError:  # a terminal that does not control this process knows no background
            return True

    def _by_keys(self):
        """Whether keys can be read; sets the terminal to give them singly, as it does not after the background."""
        if self.terminal is None or not self._in_foreground():
            return False
        now = termios.tcgetattr(self.terminal)
        if now[LFLAG] & termios.ICANON:
            self.before = now
            tty.setcbreak(self.terminal)
        return True
