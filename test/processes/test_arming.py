"""A plant in real time moves for nobody until a person has armed it, and only for as long as the person keeps it up."""

import fcntl
import os
import pty
import signal
import subprocess
import sys
import termios
import time
from pathlib import Path

import pytest
from bus import FAST, REAL_TIME, Bus, controller, inside, settings, simulator

from conftest import ROOT, TIME_LIMIT_S, start_script, wait_until
from limphome import arm_request_t, status_t
from limphome_lab import registry
from limphome_lab.channels import ARM, COMMAND, DECISION, RESET
from limphome_lab.messages import read_log, recorded
from limphome_lab.runfolder import RunFolder

SPEED = 0.3
BUILD = Path(os.environ.get("LIMPHOME_BUILD", ROOT / "build"))
PATIENT = [*REAL_TIME, "link.sender_timeout_s=1", "link.operator_timeout_s=1", "failure.actuator=none"]


def fastest(states):
    return max(abs(state.actuator_velocity[1]) for state in states)


def driving(bus, state):
    """Answers each state by full speed ahead, as a controller that knows nothing of arming would."""
    bus.command(state, SPEED, SPEED)


def start_moving(bus):
    bus.start(simulator(*PATIENT))
    bus.own()
    bus.answer = lambda state: (driving(bus, state), bus.keep_armed(state))
    assert bus.until(lambda: bus.state.armed and fastest(bus.states[-3:]) > 0.2, 10), "it does not move"


def at_rest(bus):
    """Listens until the robot must have come to rest; how fast it is then."""
    bus.listen(1)
    known = len(bus.states)
    bus.listen(0.5)
    return fastest(bus.states[known:])


def never_armed(folder):
    with Bus(folder) as bus:
        plant = bus.start(simulator(*PATIENT))
        bus.own()
        bus.answer = lambda state: driving(bus, state)
        bus.listen(2)
        return {"speed": fastest(bus.states), "reason": bus.status().reason, "words": plant.words()}


@pytest.mark.fault(
    "a plant in real time that nobody has armed",
    injected="a controller that commands full speed",
    expected="it stays at rest and says why",
)
def test_it_moves_for_nobody_until_it_is_armed(tmp_path, observe):
    seen = inside(never_armed, str(tmp_path))
    observe(str(seen))
    assert seen["speed"] < 0.01 and seen["reason"] == status_t.NOT_YET_ARMED
    assert seen["words"].splitlines() == ["not armed: nobody has armed it yet"]


def wrong_answers(folder):
    """All that is said but the answer to the present challenge."""
    with Bus(folder) as bus:
        bus.start(simulator(*PATIENT))
        bus.own()
        challenges = set()

        def mislead(state):
            driving(bus, state)
            challenges.add(state.challenge)
            for challenge in (0, 1, state.challenge + 1, *(challenges - {state.challenge})):
                bus.arm(state, challenge=challenge)
            bus.arm(state, arm_request_t.KEEP)  # keeps what is, and does not arm

        bus.answer = mislead
        bus.listen(4)
        return {
            "speed": fastest(bus.states),
            "armed": max(state.armed for state in bus.states),
            "challenges": len(challenges),
            "rejected": bus.status().rejected_challenge,
        }


@pytest.mark.fault(
    "wrong and late answers to the challenge",
    injected="0, 1, one more than it, all earlier ones, and KEEP instead of ARM",
    expected="not armed, each counted; the challenge is drawn anew in between",
)
def test_only_the_present_challenge_arms(tmp_path, observe):
    seen = inside(wrong_answers, str(tmp_path))
    observe(str(seen))
    assert seen["speed"] < 0.01 and seen["armed"] == 0
    assert seen["challenges"] >= 3 and seen["rejected"] > 50


def replay(folder):
    """What a controller and an operator said is said again, word by word, to the same plant and to a new one."""
    with Bus(folder) as bus:
        plant = bus.start(simulator(*PATIENT))
        bus.keep = (COMMAND, RESET, ARM)
        bus.own()
        bus.answer = lambda state: (driving(bus, state), bus.keep_armed(state))
        assert bus.until(lambda: bus.state.armed and fastest(bus.states[-3:]) > 0.2, 10)
        bus.listen(1.5)
        bus.answer = None
        spoken, bus.keep = list(bus.heard), ()
        bus.listen(2.5)
        seen = {"messages": len(spoken)}
        for which in ("same", "new"):
            known = len(bus.states)
            for channel, data in spoken:
                bus.lcm.publish(channel, data)
                bus.listen(0.05)
            seen[which] = [max(state.armed for state in bus.states[known:]), fastest(bus.states[known:])]
            plant.end()
            if which == "same":
                bus.start(simulator(*PATIENT))
                bus.listen(1)
        return seen


@pytest.mark.fault(
    "a recording that is played back",
    injected="all commands, resets and arm requests of a run, to the same plant and to a new one",
    expected="neither is armed or moves",
)
def test_a_recording_cannot_arm(tmp_path, observe):
    seen = inside(replay, str(tmp_path))
    observe(str(seen))
    assert seen["messages"] > 20
    for which in ("same", "new"):
        assert seen[which][0] == 0 and seen[which][1] < 0.01


def silence(folder, who):
    with Bus(folder) as bus:
        start_moving(bus)
        session = bus.state.session
        if who == "operator":
            bus.answer = lambda state: driving(bus, state)
        elif who == "controller":
            bus.answer = bus.keep_armed
        elif who == "says so":
            bus.answer = lambda state: driving(bus, state)
            bus.arm(bus.state, arm_request_t.DISARM, challenge=0, sender=5)
        else:
            bus.answer = None
        bus.until(lambda: not bus.state.armed, 5)
        bus.answer = None if who == "both" else lambda state: driving(bus, state)
        speed = at_rest(bus)
        same = bus.state.session == session
        return {"armed": bus.state.armed, "speed": speed, "reason": bus.status().reason, "same": same}


@pytest.mark.parametrize(
    "who, reasons",
    [
        ("operator", (status_t.OPERATOR_SILENT,)),
        ("controller", (status_t.CONTROLLER_SILENT,)),
        ("both", (status_t.OPERATOR_SILENT, status_t.CONTROLLER_SILENT)),
        ("says so", (status_t.BY_OPERATOR,)),
    ],
)
@pytest.mark.fault(
    "whoever keeps the robot moving falls silent, or the operator stops it",
    injected="an armed, driving plant; from then on commands alone, or leave alone, or nothing, or a DISARM of anybody",
    expected="disarmed with the reason, at rest, whatever is commanded then",
)
def test_silence_disarms(tmp_path, who, reasons, observe):
    seen = inside(silence, str(tmp_path), who)
    observe(str(seen))
    assert seen["armed"] == 0 and seen["speed"] < 0.02 and seen["reason"] in reasons and seen["same"]


def reset_while_armed(folder):
    with Bus(folder) as bus:
        start_moving(bus)
        session = bus.state.session
        bus.ask_for_reset(bus.state)
        bus.until(lambda: bus.state.session != session, 5)
        armed = bus.until(lambda: bus.state.seq > 5, 5) and all(
            state.armed for state in bus.states if state.session == bus.state.session
        )
        return {"armed": armed, "speed": fastest(bus.states[-2:])}


def test_arming_lasts_over_a_reset_that_the_owner_asks_for(tmp_path):
    seen = inside(reset_while_armed, str(tmp_path))
    assert seen["armed"] and seen["speed"] > 0.2


def foreign_keep(folder):
    with Bus(folder) as bus:
        start_moving(bus)
        bus.answer = lambda state: (driving(bus, state), bus.arm(state, arm_request_t.KEEP, sender=5))
        disarmed = bus.until(lambda: not bus.state.armed, 5)
        return {"disarmed": bool(disarmed), "rejected": bus.status().rejected_sender}


@pytest.mark.fault(
    "somebody else keeps the plant armed",
    injected="KEEP with the present challenge by another than who armed it, who is silent",
    expected="disarmed after [link] operator_timeout_s",
)
def test_only_who_armed_it_keeps_it_armed(tmp_path, observe):
    seen = inside(foreign_keep, str(tmp_path))
    observe(str(seen))
    assert seen["disarmed"] and seen["rejected"] > 3


def learn_once_armed(folder):
    with Bus(folder) as bus:
        bus.start(simulator(*REAL_TIME))
        run = bus.start(controller(f"{folder}/run", *REAL_TIME, "link.sender_timeout_s=0.5", "link.give_up_s=1"))
        bus.until(lambda: bus.counts[COMMAND] > 20)
        before = bus.counts[DECISION]
        status = bus.status(status_t.CONTROLLER)
        bus.answer = bus.keep_armed
        bus.until(lambda: bus.counts[DECISION] > 10)
        seen = {"before": before, "condition": status.condition, "reason": status.reason, "after": bus.counts[DECISION]}
        return seen | {"exit": run.end()}


@pytest.mark.fault(
    "a controller whose plant is not armed",
    injected="arming two seconds after all else is there",
    expected="it holds, decides and learns nothing, says so, does not give up, and goes on once the plant is armed",
)
def test_a_controller_waits_for_arming(tmp_path, observe):
    seen = inside(learn_once_armed, str(tmp_path))
    observe(str(seen))
    assert seen["before"] == 0 and seen["after"] > 10 and seen["exit"] == 130
    assert (seen["condition"], seen["reason"]) == (status_t.WAITING, status_t.NOT_ARMED)
    log = tmp_path / "run" / "messages.lcmlog"
    commands = [message for _, message in recorded(log, COMMAND)]
    assert not any(any(command.velocity) for command in commands[:20])
    assert not next(decision for _, decision in recorded(log, DECISION)).learned


@pytest.mark.parametrize(
    "case",
    ["InRealTimeAFaultDisarms", "InRealTimeArmingBeginsAtRest", "AMachineThatStaysIsResetAfterAFaultAlone"],
)
@pytest.mark.fault(
    "a machine that fails, is armed again at once, or cannot be carried back",
    injected="a machine of a few lines in the plant's loop",
    expected="as the name says",
)
def test_machines_in_the_loop(case, observe):
    program = BUILD / "bin" / "test_plant"
    result = subprocess.run([program, f"--gtest_filter=Loop.{case}"], capture_output=True, text=True, timeout=60)
    observe(result.stdout.strip().splitlines()[-1])
    assert result.returncode == 0 and "[  PASSED  ] 1 test." in result.stdout, result.stdout


@pytest.fixture
def launched(tmp_path, monkeypatch):
    """Starts scripts/launch with a registry of its own; `launch(*options, **streams)` gives the process."""
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    processes = []

    def launch(*options, **streams):
        command = ["launch", *settings(*FAST, "learner.kind=q_learning"), *options]
        if streams:
            process = subprocess.Popen([ROOT / "scripts" / command[0], *command[1:]], start_new_session=True, **streams)
        else:
            process = start_script(*command)
        processes.append(process)
        wait_until(process, registry.running)
        return process, RunFolder(registry.running()[0]["run"])

    yield launch
    for process in processes:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
        process.wait(TIME_LIMIT_S)


def log_of(folder, word):
    log = folder.path / "simulator.log"
    return log.exists() and word in log.read_text()


@pytest.mark.fault(
    "a launch without a terminal and without --arm",
    injected="scripts/launch with stdin from /dev/null",
    expected="it says that the robot stays disarmed, and it does",
)
def test_launch_without_a_terminal_stays_disarmed(launched, observe):
    process, folder = launched()
    wait_until(process, lambda: folder.messages.exists() and log_of(folder, "not armed"))
    time.sleep(2)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=TIME_LIMIT_S)
    decisions = sum(channel == DECISION for channel, _ in read_log(folder.messages))
    observe(f"{decisions} decisions, exit {process.returncode}")
    assert "stays disarmed" in errors and decisions == 0 and process.returncode == 130


@pytest.mark.fault(
    "a person at the terminal arms, disarms, and leaves by Ctrl-C",
    injected="scripts/launch on a pseudo-terminal: space, enter, space, Ctrl-C",
    expected="armed and disarmed by turns, disarmed before it ends, the terminal as it was",
)
def test_launch_arms_by_a_key(launched, observe):
    master, terminal = pty.openpty()
    before = termios.tcgetattr(terminal)
    process, folder = launched(stdin=terminal, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    wait_until(process, lambda: log_of(folder, "not armed: nobody"))
    wait_until(process, lambda: termios.tcgetattr(terminal) != before)

    def changes():
        lines = (folder.path / "simulator.log").read_text().splitlines()
        return [line for line in lines if line.startswith(("armed", "not armed"))]

    for count, key in enumerate((b" ", b"\n", b" "), 2):
        time.sleep(1.1)
        os.write(master, key)
        wait_until(process, lambda count=count: len(changes()) == count)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=TIME_LIMIT_S)
    observe(" / ".join(changes()))
    assert process.returncode == 130
    assert [line.startswith("armed") for line in changes()][:4] == [False, True, False, True]
    assert changes()[2] == "not armed: the operator has said so"
    assert termios.tcgetattr(terminal) == before
    os.close(master)
    os.close(terminal)
    assert "space or enter" in errors


# a shell with job control, as far as it matters: its job is in the background until SIGUSR1
SHELL = """
import os, signal, subprocess, sys
job = subprocess.Popen(sys.argv[1:], process_group=0)
signal.signal(signal.SIGUSR1, lambda *_: os.tcsetpgrp(0, job.pid))
sys.exit(job.wait() % 256)
"""


@pytest.mark.fault(
    "a launch in the background",
    injected="scripts/launch & at a terminal, later fg",
    expected="it runs on and leaves the terminal alone; in the foreground a key arms the robot",
)
def test_launch_in_the_background(tmp_path, monkeypatch, observe):
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    master, terminal = pty.openpty()
    before = termios.tcgetattr(terminal)
    shell = subprocess.Popen(
        [sys.executable, "-c", SHELL, ROOT / "scripts" / "launch", *settings(*FAST)],
        stdin=terminal,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0),
    )
    wait_until(shell, registry.running)
    pair = registry.running()[0]
    folder = RunFolder(pair["run"])
    try:
        wait_until(shell, lambda: log_of(folder, "not armed: nobody"))
        time.sleep(1)
        assert "State:\tT" not in Path(f"/proc/{pair['pid']}/status").read_text()
        assert termios.tcgetattr(terminal) == before
        shell.send_signal(signal.SIGUSR1)
        wait_until(shell, lambda: termios.tcgetattr(terminal) != before)
        time.sleep(1.1)
        os.write(master, b" ")
        wait_until(shell, lambda: log_of(folder, "\narmed"))
    finally:
        os.kill(pair["pid"], signal.SIGCONT)
        os.kill(pair["pid"], signal.SIGINT)
        errors = shell.communicate(timeout=TIME_LIMIT_S)[1]
    assert shell.returncode == 130, errors
    assert termios.tcgetattr(terminal) == before
    os.close(master)
    os.close(terminal)
    observe("ran in the background, armed by a key in the foreground, exit code 130")
