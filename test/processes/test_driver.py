"""The example of a driver on a CAN bus, between the real controller and simulated motor controllers, in real time.

The bus is a serial line with an SLCAN adapter at either end, and Linux's vcan too where the kernel has it.
"""

import contextlib
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from bus import REAL_TIME, Bus, controller, inside, settings

from conftest import ROOT, TIME_LIMIT_S, run_script, start_script, wait_until
from limphome import arm_request_t, status_t
from limphome_lab import network, paths, registry
from limphome_lab.channels import COMMAND, POSE, STATE
from limphome_lab.messages import recorded
from limphome_lab.recording import TornRecording
from limphome_lab.runfolder import RunFolder, resolve_settings

EXAMPLE = ROOT / "examples" / "driver"
EXPERIMENT = ROOT / "config" / "smoke.ini"
SETTINGS = [*REAL_TIME, "learning.episodes=1000000", "link.give_up_s=0"]
SILENCE = ["--silence", "1"]  # [s]: this machine has other things to do, too
LEFT_CRAWLER, ARM = 0, 4
REST_S = 0.3
MOVED = 0.02  # [m or rad]


def has_vcan():
    made = ["ip", "link", "add", "dev", "vcan0", "type", "vcan"]
    prefix = network.private_prefix()
    return prefix is not None and subprocess.run([*prefix, *made], capture_output=True).returncode == 0


class Machine:
    """A driver and its motors on the bus of `interface`; files in `folder`."""

    def __init__(self, bus, interface):
        self.bus, self.interface = bus, interface
        self.experiment = bus.folder / "experiment.ini"
        self.experiment.write_text(resolve_settings(EXPERIMENT, SETTINGS))
        if interface is None:  # it needs none
            return
        if interface == "slcan":
            self.ends = [str(bus.folder / name) for name in ("driver.tty", "motors.tty")]
            self.start_python("cable.py", *self.ends)
            assert bus.until(lambda: all(Path(end).exists() for end in self.ends))
        else:
            self.ends = ["vcan0", "vcan0"]
            for words in ("add dev vcan0 type vcan", "set vcan0 up"):
                subprocess.run(["ip", "link", *words.split()], check=True)

    def start_python(self, name, *arguments):
        return self.bus.start([sys.executable, EXAMPLE / name, *arguments])

    def start_motors(self):
        options = ["--interface", self.interface, "--failed", "1", *SILENCE]
        return self.start_python("motors.py", *options, self.ends[1])

    def start_driver(self):
        program = paths.program("can-driver")
        common = ["--config", self.experiment, "--lcm-url", network.lcm_url()]
        return self.bus.start([program, *common, *SILENCE, self.ends[0]])

    def start_driver_in_python(self):
        return self.start_python("driver.py", "--config", self.experiment, "--lcm-url", network.lcm_url())

    def start_controller(self):
        return self.bus.start(controller(self.bus.folder / "run", *SETTINGS))

    def arm(self):
        """A person arms it and keeps it armed; whether it then moves."""
        begin = self.bus.state
        self.bus.answer = self.bus.keep_armed
        return self.bus.until(
            lambda: self.bus.state.armed and self.travel(begin) > MOVED and self.bus.state.reset_sender != 0
        )

    def travel(self, begin):
        """The farthest that a motor went since."""
        both = zip(begin.actuator_position, self.bus.state.actuator_position, strict=True)
        return max(abs(after - before) for before, after in both)

    def rests(self):
        """Whether no motor moves any more."""
        self.bus.until(lambda: not any(self.bus.state.actuator_velocity))
        begin = self.bus.state
        self.bus.listen(REST_S)
        return self.travel(begin) == 0

    def tells(self, reason):
        """Whether the plant says so from now on."""
        told = self.bus.statuses[status_t.PLANT]
        known = len(told)
        return self.bus.until(lambda: any(status.reason == reason for status in told[known:]))


def drive(folder, interface):
    """What was seen of all that may happen to a machine, one after the other."""
    seen = {}
    with Bus(folder) as bus:
        machine = Machine(bus, interface)
        driver = machine.start_driver()
        assert bus.until(lambda: "waiting: motor 1 is silent" in driver.words())
        seen["states before all nodes have spoken"] = len(bus.states)
        motors = machine.start_motors()
        machine.start_controller()
        assert bus.until(lambda: bus.states and bus.state.reset_sender != 0)
        first = bus.state
        seen["first"] = [first.num_actuators, first.armed, first.reset, *first.actuator_health[:5]]
        seen["home"] = [round(angle, 4) for angle in first.actuator_position[:5]]
        seen["rests until armed"] = machine.rests()
        seen["moves armed"] = machine.arm()
        seen["reckons where it is"] = bus.until(lambda: any(bus.state.position))
        seen["the failed one stays"] = bus.state.actuator_position[LEFT_CRAWLER] == 0

        bus.answer = None
        bus.arm(bus.state, arm_request_t.DISARM)
        seen["disarmed"] = machine.tells(status_t.BY_OPERATOR)
        seen["rests disarmed"] = machine.rests()

        machine.arm()
        session = bus.state.session
        motors.signal(signal.SIGUSR2)
        seen["newly failed"] = bus.until(lambda: bus.state.actuator_health[ARM] == 1) and bus.state.session == session

        motors.signal(signal.SIGUSR1)
        bus.answer = None  # a person does not arm what stands in an emergency
        seen["emergency stop"] = machine.tells(status_t.MACHINE_FAILED)
        motors.signal(signal.SIGUSR1)
        seen["new session"] = bus.until(lambda: bus.state.session != session and bus.state.reset_sender != 0)
        seen["rests after it"] = machine.rests() and not bus.state.armed
        seen["moves after it"] = machine.arm()

        session = bus.state.session
        bus.answer = None
        motors.signal(signal.SIGKILL)
        seen["motors died"] = machine.tells(status_t.MACHINE_FAILED)
        machine.start_motors()
        assert bus.until(lambda: bus.state.session != session and bus.state.reset_sender != 0)
        seen["moves again"] = machine.arm()

        last = bus.state
        driver.signal(signal.SIGKILL)
        bus.answer = None
        bus.listen(2)
        known = len(bus.states)
        driver = machine.start_driver()
        assert bus.until(lambda: len(bus.states) > known)
        seen["motors rest without a driver"] = not any(bus.state.actuator_velocity) and machine.travel(last) < 0.6
        seen["moves with another"] = machine.arm()
        seen["commands"] = bus.counts[COMMAND] > 0
        seen["viewers see it move"] = bus.counts[POSE] > 2 * bus.counts[STATE]
        seen["driver's end"] = driver.end()
        seen["words"] = bus.programs[1 if interface == "slcan" else 0].words()
    return seen


TROUBLE = pytest.mark.fault(
    "a machine on a CAN bus is stopped, breaks and falls silent",
    injected="in turn: it is disarmed, a motor fails, the emergency stop, the motor controllers die, the driver dies",
    expected="all motors come to rest each time, it is said why, and it moves on once a person has armed it again",
)


@pytest.mark.parametrize("interface", [pytest.param("slcan", marks=TROUBLE), "socketcan"])
def test_machine_on_a_can_bus(tmp_path, observe, interface):
    if interface == "socketcan" and not has_vcan():
        pytest.skip("this kernel has no vcan")
    seen = inside(drive, str(tmp_path), interface)
    words = seen.pop("words")
    observe("; ".join(what for what, good in seen.items() if good))
    assert "motor 1 has no power: all motors stop" in words
    assert "is silent: all motors stop" in words
    assert seen.pop("states before all nodes have spoken") == 0
    assert seen.pop("first") == [5, 0, 1, 1, 0, 0, 0, 0]
    assert seen.pop("home") == [0, 0, 0, 0.6, -1.5]
    assert seen.pop("driver's end") == 0
    assert [what for what, good in seen.items() if not good] == []


def drive_by_messages(folder):
    """The driver in Python, on the messages alone."""
    seen = {}
    with Bus(folder) as bus:
        machine = Machine(bus, None)
        driver = machine.start_driver_in_python()
        machine.start_controller()
        assert bus.until(lambda: bus.states and bus.state.reset_sender != 0)
        seen["sound"] = (
            bus.state.reset == 1 and not bus.state.armed and bus.state.actuator_health[:5] == (1, 0, 0, 0, 0)
        )
        seen["rests until armed"] = machine.rests()
        bus.arm(bus.state, challenge=12345)
        seen["takes no other challenge"] = machine.rests()
        seen["moves armed"] = machine.arm()
        seen["not held"] = bus.until(lambda: bus.state.armed and not bus.state.held)
        seen["obeys no other"] = not obeyed(bus, machine)
        bus.answer = None  # the operator falls silent
        seen["disarms itself"] = bus.until(lambda: not bus.state.armed)
        seen["rests disarmed"] = machine.rests()
        seen["moves again"] = machine.arm()
        session = bus.state.session
        bus.programs[1].signal(signal.SIGKILL)
        bus.answer = None
        seen["disarms without a controller"] = bus.until(lambda: not bus.state.armed)
        seen["rests without a controller"] = machine.rests() and bus.state.session == session
        bus.start(controller(bus.folder / "second", *SETTINGS))
        assert bus.until(lambda: bus.state.session != session)
        seen["moves for another"] = machine.arm()
        seen["runs"] = driver.running()
    return seen


def obeyed(bus, machine):
    """Whether the left joints go where somebody else commands them."""
    for _ in range(10):
        bus.command(bus.state, 0.0, 0.0, 0.0, 0.0, 99.0)
        bus.listen(0.05)
        if max(map(abs, bus.state.actuator_velocity)) > 0.31:
            return True
    return False


def test_driver_on_the_messages_alone(tmp_path):
    seen = inside(drive_by_messages, str(tmp_path))
    assert [what for what, good in seen.items() if not good] == []


def test_launch_starts_a_driver_in_place_of_the_simulator(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    command = f"{sys.executable} '{EXAMPLE / 'driver.py'}'"
    process = start_script("launch", "--config", EXPERIMENT, "--driver", command, "--arm", *settings(*REAL_TIME))
    wait_until(process, registry.running)
    run = RunFolder(registry.running()[0]["run"])
    try:
        wait_until(process, lambda: run.messages.exists() and any(moved(run)))
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=TIME_LIMIT_S)
        assert process.returncode == 130 and "armed: the robot moves" in errors
        assert all(state.reset == state.WHERE_IT_IS for _, state in recorded(run.messages, STATE))  # no simulator does
    finally:
        shutil.rmtree(run.path)


def moved(run):
    """Whether each state that has been recorded tells of motion."""
    with contextlib.suppress(TornRecording):  # it is being written
        for _, state in recorded(run.messages, STATE):
            yield any(state.actuator_velocity)


def lose_the_bus(folder):
    with Bus(folder) as bus:
        machine = Machine(bus, "slcan")
        machine.start_motors()
        driver = machine.start_driver()
        assert bus.until(lambda: bus.states)
        bus.programs[0].signal(signal.SIGKILL)  # the adapter is pulled out
        code = driver.process.wait(30)
        return [code, driver.words().splitlines()[-1]]


@pytest.mark.fault(
    "the adapter of a driver is gone",
    injected="its serial line is hung up",
    expected="it ends with exit code 1 and says so",
)
def test_driver_ends_where_its_adapter_is_gone(tmp_path, observe):
    ended = inside(lose_the_bus, str(tmp_path))
    observe(str(ended))
    assert ended == [1, "CAN adapter: Input/output error"]


@pytest.mark.parametrize(
    "arguments, says",
    [
        (["--config", EXPERIMENT, "/no/such/line"], (1, "/no/such/line: No such file or directory")),
        (["--config", EXPERIMENT, "--actuators", "9", "can0"], (2, "usage")),
        (["can0"], (2, "usage")),
        (["--config", "/no/such.ini", "can0"], (2, "/no/such.ini")),
    ],
)
def test_driver_says_what_is_wrong_with_its_words(arguments, says):
    result = subprocess.run([paths.program("can-driver"), *map(str, arguments)], capture_output=True, text=True)
    assert result.returncode == says[0] and says[1] in result.stderr


def test_a_command_of_no_words_is_refused():
    result = run_script("launch", "--driver", " ", check=False)
    assert result.returncode == 2 and "--driver: names no program" in result.stderr
