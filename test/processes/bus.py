"""A network of their own for tests that talk to the programs themselves.

def talk(folder):  # runs inside, in a process of its own; what it returns goes through JSON
    with Bus() as bus:
        plant = bus.start(simulator())
        ...
        return {"what": "was seen"}

def test_x(tmp_path):
    seen = inside(talk, str(tmp_path))
"""

import inspect
import json
import os
import random
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import lcm
import pytest

from conftest import ROOT, SMOKE, TIME_LIMIT_S
from limphome import arm_request_t, reset_request_t, robot_state_t, status_t, velocity_command_t
from limphome_lab import network, paths
from limphome_lab.channels import ARM, COMMAND, RESET, STATE, STATUS
from limphome_lab.messages import TYPES

HERE = Path(__file__).parent
CALL = "import json, sys, {0}; print('\\n' + json.dumps({0}.{1}(*json.loads(sys.argv[1]))))"


def inside(function, *arguments):
    """What `function` of a test module returns when it is called in a network of its own."""
    prefix = network.private_prefix()
    if prefix is None:
        pytest.skip("network namespaces are not permitted here")
    module = inspect.getmodule(function).__name__
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(HERE), *sys.path])}
    result = subprocess.run(
        [*prefix, sys.executable, "-c", CALL.format(module, function.__name__), json.dumps(arguments)],
        capture_output=True,
        text=True,
        timeout=TIME_LIMIT_S,
        env=environment,
        cwd=HERE,
    )
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout.splitlines()[-1])


def settings(*assignments):
    return [word for each in assignments for word in ("--set", each)]


FAST = [  # decisions ten times a second; that needs accelerations that the monitor lets pass
    "episode.decision_period_s=0.1",
    "safety.crawler_acceleration=6",
    "safety.joint_acceleration=6",
]
REAL_TIME = ["simulator.pace=real_time", *FAST]


def simulator(*assignments):
    """Command line of a plant."""
    return [paths.program("simulator"), *COMMON, *settings(*assignments)]


def controller(out, *assignments):
    return [paths.program("controller"), *COMMON, "--out", out, *settings(*assignments)]


COMMON = ["--config", SMOKE, "--robot", ROOT / "config" / "crawler.urdf", "--lcm-url", network.lcm_url()]


class Program:
    """One that runs, with what it says on stderr."""

    def __init__(self, command, log):
        self.log = log
        with open(log, "w") as errors:
            self.process = subprocess.Popen([*map(str, command)], stdout=subprocess.DEVNULL, stderr=errors)
        self.pid = self.process.pid

    def words(self):
        return self.log.read_text()

    def running(self):
        return self.process.poll() is None

    def signal(self, number):
        self.process.send_signal(number)

    def end(self):
        """Ends it as a person would; returns its exit code."""
        if self.running():
            self.signal(signal.SIGCONT)
            self.signal(signal.SIGTERM)
        try:
            return self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            return self.process.wait()


class Bus:
    """Ears and a mouth on the bus, and the programs that were started; leaving it ends them."""

    def __init__(self, folder="."):
        self.folder = Path(folder)
        self.lcm = lcm.LCM(network.lcm_url())
        self.lcm.subscribe("LIMPHOME_.*", self._hear).set_queue_capacity(5000)
        self.heard = []  # (channel, encoded)
        self.counts = Counter()
        self.states = []
        self.statuses = {status_t.PLANT: [], status_t.CONTROLLER: []}
        self.programs = []
        self.keep = ()  # channels whose messages are kept in `heard`
        self.answer = None  # called with each state
        self.sender = random.getrandbits(62) + 1

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for program in self.programs:
            program.end()

    def start(self, command):
        program = Program(command, self.folder / f"{Path(command[0]).name}-{len(self.programs)}.log")
        self.programs.append(program)
        return program

    def _hear(self, channel, data):
        self.counts[channel] += 1
        if channel in self.keep:
            self.heard.append((channel, data))
        if channel not in (STATE, STATUS):
            return
        message = TYPES[channel].decode(data)
        if channel == STATUS:
            self.statuses[message.process].append(message)
            return
        self.states.append(message)
        if self.answer:
            self.answer(message)

    @property
    def state(self):
        return self.states[-1]

    def listen(self, seconds):
        """Takes in what comes for a while."""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            self.lcm.handle_timeout(max(1, int(left * 1000)))

    def until(self, condition, seconds=30):
        """Takes in what comes until `condition()`; the last value it had."""
        end = time.monotonic() + seconds
        while not (value := condition()) and time.monotonic() < end:
            self.lcm.handle_timeout(20)
        return value

    def say(self, channel, message):
        self.lcm.publish(channel, message.encode())

    def ask_for_reset(self, state, sender=None, nonce=None, episode=1):
        request = reset_request_t()
        request.session, request.seq, request.episode = state.session, state.seq, episode
        request.sender, request.nonce = sender or self.sender, nonce or random.getrandbits(62) + 1
        self.say(RESET, request)
        return request

    def command(self, state, *velocity, sender=None):
        command = velocity_command_t()
        command.session, command.seq = state.session, state.seq
        command.sender, command.num_actuators = sender or self.sender, state.num_actuators
        command.velocity[: len(velocity)] = velocity
        self.say(COMMAND, command)
        return command

    def arm(self, state, action=arm_request_t.ARM, challenge=None, sender=99):
        request = arm_request_t()
        request.sender, request.action = sender, action
        request.challenge = state.challenge if challenge is None else challenge
        self.say(ARM, request)
        return request

    def keep_armed(self, state):
        self.arm(state, arm_request_t.KEEP if state.armed else arm_request_t.ARM)

    def own(self, sender=None):
        """Asks for a session until there is one that `sender` owns; its first state."""
        sender = sender or self.sender
        assert self.until(lambda: self.states), "no plant is heard"
        for _ in range(200):
            if self.state.reset_sender == sender:
                return self.state
            self.ask_for_reset(self.state, sender)
            self.listen(0.05)
        raise AssertionError("no session was granted")

    def status(self, process=status_t.PLANT):
        """The next status that a process tells."""
        known = len(self.statuses[process])
        self.until(lambda: len(self.statuses[process]) > known, 5)
        return self.statuses[process][-1]


class FakeRobot:
    """States of a plant that does nothing, for what is to be told to a controller."""

    def __init__(self, lockstep=1):
        self.session, self.seq = random.getrandbits(62), 0
        self.owner = self.nonce = 0
        self.lockstep = lockstep

    def begin(self, request):
        self.session, self.seq = random.getrandbits(62), 0
        self.owner, self.nonce = request.sender, request.nonce

    def state(self, **fields):
        state = robot_state_t()
        state.session, state.seq, state.lockstep, state.armed = self.session, self.seq, self.lockstep, 1
        state.reset_sender, state.reset_nonce = self.owner, self.nonce
        state.sent = time.monotonic_ns() // 1000
        state.utime = self.seq * 500_000
        state.num_actuators = 5
        state.orientation = [2**-0.5, 0.0, 0.0, 2**-0.5]
        state.actuator_position[:5] = [0.0, 0.0, 0.0, 0.6, -1.5]
        state.actuator_health[0] = 1
        for field, value in fields.items():
            setattr(state, field, value)
        return state
