"""Forged datagrams at both programs: they live, and learn what they would have learned."""

import json
import subprocess
import sys
from pathlib import Path

import datagrams
import pytest

from conftest import SMOKE, TIME_LIMIT_S
from limphome_lab import network
from limphome_lab.runfolder import RunFolder

MOST_MEMORY_KB = 100_000


def learn(out, kind):
    """Ten episodes while datagrams of a kind come in; returns what datagrams.py tells and the run folder."""
    prefix = network.private_prefix()
    if prefix is None:
        pytest.skip("network namespaces are not permitted here")
    shorter = ["--set", "learning.episodes=10", "--set", "episode.step_limit=40"]
    command = [sys.executable, Path(__file__).with_name("datagrams.py"), kind, network.lcm_url(), out]
    result = subprocess.run(
        [*prefix, *map(str, command), "--config", SMOKE, *shorter], capture_output=True, text=True, timeout=TIME_LIMIT_S
    )
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout), RunFolder(out)


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    report, folder = learn(tmp_path_factory.mktemp("undisturbed") / "run", "none")
    assert report["controller"] == report["simulator"] == report["sent"] == 0
    return folder


@pytest.mark.parametrize(
    "kind",
    [
        pytest.param(
            kind,
            marks=pytest.mark.fault(
                f"forged datagram: {kind}",
                injected="sent to the group over and over while both programs learn in lockstep",
                expected="both live, within 100 MB; episodes and policy byte for byte those of an undisturbed run",
            ),
        )
        for kind in datagrams.KINDS
        if kind != "none"
    ],
)
def test_forged_datagrams_change_nothing(tmp_path, undisturbed, observe, kind):
    report, folder = learn(tmp_path / "run", kind)
    codes = f"exit codes {report['controller']} and {report['simulator']}"
    observe(f"{report['sent']} datagrams, {codes}, {report['memory']} kB")
    assert report["controller"] == report["simulator"] == 0
    assert report["sent"] > 100
    assert report["memory"] < MOST_MEMORY_KB
    assert folder.episodes.read_bytes() == undisturbed.episodes.read_bytes()
    assert folder.policy.read_bytes() == undisturbed.policy.read_bytes()
