"""However a run ends, no process stays behind and what is left can be used."""

import json
import os
import shutil
import signal
import time

import pytest

from conftest import SMOKE, TIME_LIMIT_S, processes_that_mention, run_script, start_script, wait_until
from limphome_lab.runfolder import RunFolder


@pytest.fixture
def running(tmp_path):
    """(process, run folder) of a training run that has finished three episodes."""
    folder = RunFolder(tmp_path / "run")
    process = start_script("train", "--config", SMOKE, "--out", folder.path, "--quiet")
    wait_until(process, lambda: len(folder.read_episodes()) >= 3)
    yield process, folder
    if process.poll() is None:
        process.kill()
    process.communicate()


def program_of(folder, name):
    """Process id of one of the two programs of a run."""
    for pid in processes_that_mention(folder.path):
        with open(f"/proc/{pid}/comm") as comm:
            if comm.read().strip() == f"limphome-{name}"[:15]:
                return pid
    raise AssertionError(f"limphome-{name} is not running")


def wait_until_gone(folder):
    """The kernel tells the programs of the script's death; they end in their own time, and must."""
    deadline = time.monotonic() + TIME_LIMIT_S
    while processes_that_mention(folder.path):
        assert time.monotonic() < deadline, "programs stayed behind"
        time.sleep(0.02)


def test_ctrl_c(running):
    process, folder = running
    os.killpg(process.pid, signal.SIGINT)  # as a terminal does
    process.communicate(timeout=TIME_LIMIT_S)
    assert process.returncode == 130
    assert processes_that_mention(folder.path) == []
    rows = folder.read_episodes()
    assert 3 <= len(rows) < 30
    assert folder.policy.exists() and folder.manifest.exists()
    assert (folder.figures / "fig9_motion.png").exists()
    run_script("plot", folder.path)


@pytest.mark.fault(
    "Ctrl-C while the script is still loading",
    injected="SIGINT 0.1 to 0.6 s after the start of train, evaluate and launch",
    expected="exit code 130, nothing told but a line",
)
@pytest.mark.parametrize("name", ["train", "evaluate", "launch"])
def test_ctrl_c_at_the_start(smoke_run, tmp_path, observe, name):
    arguments = {
        "train": ("--config", SMOKE, "--out", tmp_path / "run", "--quiet", "--no-figures"),
        "evaluate": (smoke_run.path, "--out", tmp_path / "run"),
        "launch": ("--help-is-not-asked-for",),  # refused once all is loaded, so that no folder is left below runs/
    }[name]
    codes = []
    for delay_s in (0.1, 0.2, 0.3, 0.4, 0.6):
        process = start_script(name, *arguments)
        time.sleep(delay_s)
        os.killpg(process.pid, signal.SIGINT)
        _, errors = process.communicate(timeout=TIME_LIMIT_S)
        assert "Traceback" not in errors, f"after {delay_s} s"
        codes.append(process.returncode if process.returncode >= 0 else 128 - process.returncode)  # as a shell
        shutil.rmtree(tmp_path / "run", ignore_errors=True)
    assert set(codes) <= ({130, 2} if name == "launch" else {130})
    observe(f"exit codes {sorted(set(codes))}, no traceback")


def test_script_that_is_killed_takes_the_programs_along(running):
    process, folder = running
    assert program_of(folder, "simulator") and program_of(folder, "controller")
    process.kill()
    process.communicate(timeout=TIME_LIMIT_S)
    wait_until_gone(folder)


@pytest.mark.parametrize("name", ["simulator", "controller"])
def test_program_that_dies_is_told(running, name):
    process, folder = running
    os.kill(program_of(folder, name), signal.SIGKILL)
    _, errors = process.communicate(timeout=TIME_LIMIT_S)
    assert process.returncode == 1
    assert f"limphome-{name} ended early (signal SIGKILL)" in errors
    assert processes_that_mention(folder.path) == []


@pytest.mark.fault(
    "a program hangs",
    injected="SIGSTOP",
    expected="train says within 20 s which process it is and how; the run goes on after SIGCONT",
)
@pytest.mark.parametrize("name", ["simulator", "controller"])
def test_program_that_is_stopped_is_told(running, observe, name):
    process, folder = running
    pid = program_of(folder, name)
    began = time.monotonic()
    os.kill(pid, signal.SIGSTOP)
    while "no progress" not in (line := process.stderr.readline()):
        assert line
    told_after = time.monotonic() - began
    assert line.endswith(f"limphome-{name} is stopped by a signal; SIGCONT lets it go on\n")
    os.kill(pid, signal.SIGCONT)
    assert process.wait(TIME_LIMIT_S) == 0
    observe(f"told after {told_after:.0f} s: {line.strip()}")


@pytest.mark.fault(
    "a program that was stopped is to end",
    injected="SIGSTOP of both programs, then Ctrl-C",
    expected="both end, within the time that they are given to end cleanly",
)
def test_programs_that_are_stopped_end(running, observe):
    process, folder = running
    for name in ("simulator", "controller"):
        os.kill(program_of(folder, name), signal.SIGSTOP)
    os.killpg(process.pid, signal.SIGINT)
    process.communicate(timeout=TIME_LIMIT_S)
    assert process.returncode == 130
    assert processes_that_mention(folder.path) == []
    observe("exit code 130, nothing left behind")


@pytest.mark.fault(
    "the terminal is closed",
    injected="SIGHUP",
    expected="both programs end cleanly, manifest and policy are written",
)
def test_hang_up(running, observe):
    process, folder = running
    os.killpg(process.pid, signal.SIGHUP)
    _, errors = process.communicate(timeout=TIME_LIMIT_S)
    assert process.returncode == 129 and "Traceback" not in errors
    assert processes_that_mention(folder.path) == []
    assert json.loads(folder.manifest.read_text())["result"] == "interrupted" and folder.policy.exists()
    observe("exit code 129, manifest says interrupted")


@pytest.mark.fault("a run under nohup", injected="SIGHUP ignored from the start, then sent", expected="it goes on")
def test_hang_up_is_ignored_where_it_was_from_the_start(tmp_path, observe):
    folder = RunFolder(tmp_path / "run")
    process = start_script(
        "train",
        *("--config", SMOKE, "--out", folder.path, "--quiet", "--no-figures"),
        preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN),
    )
    wait_until(process, lambda: len(folder.read_episodes()) >= 3)
    os.killpg(process.pid, signal.SIGHUP)
    assert process.wait(TIME_LIMIT_S) == 0, process.communicate()[1]
    assert len(folder.read_episodes()) == 30
    observe("30 episodes, exit code 0")
