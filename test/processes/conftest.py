"""Runs that the tests share. All of them talk on a loopback of their own."""

import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SMOKE = ROOT / "config" / "smoke.ini"
TIME_LIMIT_S = 300  # against a hang only; nothing here measures time


def run_script(name, *arguments, check=True, **options):
    """Runs scripts/NAME to its end; with `check`, it must succeed."""
    result = subprocess.run(
        [ROOT / "scripts" / name, *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=TIME_LIMIT_S,
        stdin=subprocess.DEVNULL,
        **options,
    )
    assert not check or result.returncode == 0, f"{name}: exit {result.returncode}\n{result.stderr}\n{result.stdout}"
    return result


def start_script(name, *arguments, **options):
    """Starts scripts/NAME in a process group of its own, as a shell does; returns the Popen."""
    return subprocess.Popen(
        [ROOT / "scripts" / name, *map(str, arguments)],
        stdin=subprocess.DEVNULL,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
        **{"preexec_fn": heed_signals, **options},
    )


def heed_signals():
    """As a shell's child does, also where the tests run under nohup or in the background of a script."""
    for number in (signal.SIGHUP, signal.SIGINT):
        signal.signal(number, signal.SIG_DFL)


def train(out, *arguments, check=True):
    """Trains by config/smoke.ini into `out`; returns the result of the script."""
    return run_script("train", "--config", SMOKE, "--out", out, "--quiet", *arguments, check=check)


def wait_until(process, condition):
    """Waits for `condition()` while `process` runs."""
    deadline = time.monotonic() + TIME_LIMIT_S
    while not condition():
        assert process.poll() is None, process.communicate()[1]
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(0.02)


def processes_that_mention(text):
    """Ids of the processes whose command line holds `text`, this one left out."""
    found = []
    for entry in Path("/proc").iterdir():
        try:
            if (
                entry.name.isdigit()
                and int(entry.name) != os.getpid()
                and str(text).encode() in (entry / "cmdline").read_bytes()
            ):
                found.append(int(entry.name))
        except (FileNotFoundError, ProcessLookupError):
            continue
    return found


@pytest.fixture(scope="session")
def smoke_run(tmp_path_factory):
    """Run folder of 30 episodes, seed 1."""
    from limphome_lab.runfolder import RunFolder

    out = tmp_path_factory.mktemp("smoke") / "run"
    train(out)
    return RunFolder(out)


@pytest.fixture
def launched(smoke_run, tmp_path, monkeypatch):
    """scripts/launch, in real time, with its registry to itself."""
    from bus import FAST, settings

    from limphome_lab import registry

    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    process = start_script(
        "launch",
        "--arm",
        "--policy",
        smoke_run.path,
        *settings("episode.step_limit=2", *FAST),
    )
    wait_until(process, registry.running)
    pair = registry.running()[0]
    yield process, pair
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
    process.communicate(timeout=TIME_LIMIT_S)
    shutil.rmtree(pair["run"])


@pytest.fixture
def browser():
    import browsing

    yield from browsing.browser()


def geared_robot(folder):
    """File of a robot geared beyond reason, whose world diverges when a crawler drives."""
    robot = folder / "geared.urdf"
    text = (ROOT / "config" / "crawler.urdf").read_text()
    for reasonable, absurd in (
        ('radius="0.18"', 'radius="0.0001"'),
        ('0.475 0.18" length', '0.475 0.0001" length'),
        ('effort="1000" velocity="5"', 'effort="1e9" velocity="1e4"'),
    ):
        text = text.replace(reasonable, absurd)
    robot.write_text(text)
    return robot
