"""The tests of hardening and of the soak, as rows of the table of faults."""

import json
import subprocess
import sys

import pytest

from conftest import ROOT, TIME_LIMIT_S
from limphome_lab import network, paths


@pytest.mark.fault(
    "one protection is left out of a program",
    injected="a program is built without each of PIE, RELRO, BIND_NOW, stack protector, fortify, CET in turn",
    expected="the check names it, and nothing for either of the programs",
)
def test_missing_hardening_is_noticed(observe):
    tests = ["ctest", "--test-dir", paths.BUILD, "-R", "^hardening", "--no-tests=error", "--output-on-failure"]
    result = subprocess.run(tests, capture_output=True, text=True, timeout=TIME_LIMIT_S)
    observe(result.stdout.strip().splitlines()[-3].strip() if result.returncode == 0 else result.stdout[-500:])
    assert result.returncode == 0


@pytest.mark.fault(
    "both programs run for long",
    injected="3000 decisions in lockstep and 15 s in real time (scripts/soak; by default a million and an hour)",
    expected="memory, descriptors, threads and the recording do not grow",
)
@pytest.mark.skipif(network.private_prefix() is None, reason="network namespaces are not permitted here")
def test_soak(tmp_path, observe):
    command = [sys.executable, "-m", "limphome_lab.measure.soak", "--decisions", "3000", "--seconds", "15"]
    result = subprocess.run(
        [
            *command,
            "--config",
            ROOT / "config" / "smoke.ini",
            "--json",
            tmp_path / "soak.json",
            "--plot",
            tmp_path / "soak.png",
        ],
        capture_output=True,
        text=True,
        timeout=TIME_LIMIT_S,
    )
    parts = json.loads((tmp_path / "soak.json").read_text())
    for part in parts:
        last = part["samples"][-1]
        observe(
            f"{part['pace']}: {part['decisions']} decisions, {last['simulator.memory_kb']} and "
            f"{last['controller.memory_kb']} kB, p99 {part['latency_s']['p99'] * 1e6:.0f} us"
        )
    assert [part["pace"] for part in parts] == ["lockstep", "real_time"], result.stderr
    assert all(part["decisions"] > 0 and part["latency_s"]["worst"] > 0 for part in parts)
    # a run this short has few samples: what grows is told of long ones
    grown = [sentence for part in parts for sentence in part["grown"] if "too short" not in sentence]
    assert not grown and result.returncode in (0, 1)
    assert (tmp_path / "soak.png").stat().st_size > 1000
