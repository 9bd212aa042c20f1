"""The controller on a link that loses, repeats, reorders and garbles: it costs time, never correctness."""

import json
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

from conftest import ROOT, SMOKE, TIME_LIMIT_S
from limphome import status_t
from limphome_lab import network, paths
from limphome_lab.channels import DECISION, STATUS
from limphome_lab.messages import recorded
from limphome_lab.runfolder import RunFolder

FAULTS = {
    "loss": {"drop": 0.3},
    "duplication": {"duplicate": 0.5},
    "reordering": {"reorder": 0.5},
    "garbage": {"garbage": 0.3},
    "all at once": {"drop": 0.2, "duplicate": 0.2, "reorder": 0.2, "garbage": 0.2},
}


def learn(out, config=SMOKE, settings=(), **faults):
    """Ten episodes on a fake plant; returns its report and the run folder."""
    prefix = network.private_prefix()
    if prefix is None:
        pytest.skip("network namespaces are not permitted here")
    controller = [
        paths.program("controller"),
        "--config",
        config,
        "--robot",
        ROOT / "config" / "crawler.urdf",
        "--out",
        out,
        "--lcm-url",
        network.lcm_url(),
        "--set",
        "learning.episodes=10",
        "--set",
        "episode.reset_every=3",
        "--set",
        "episode.step_limit=40",
        *(word for each in settings for word in ("--set", each)),
    ]
    result = subprocess.run(
        [
            *prefix,
            sys.executable,
            Path(__file__).with_name("fake_plant.py"),
            json.dumps({"seed": 5, **faults}),
            network.lcm_url(),
            *map(str, controller),
        ],
        capture_output=True,
        text=True,
        timeout=TIME_LIMIT_S,
    )
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout), RunFolder(out)


@pytest.fixture(scope="module")
def clean(tmp_path_factory):
    return learn(tmp_path_factory.mktemp("clean") / "run")


@pytest.mark.fault(
    "a link that mistreats messages",
    injected="states and commands lost, repeated, out of order or garbled, by a plant that does so at random",
    expected="policy and episodes are those of a clean link, byte for byte",
)
@pytest.mark.parametrize("faults", FAULTS.values(), ids=FAULTS)
def test_faults_change_nothing_that_is_learned(tmp_path, clean, faults, observe):
    report, folder = learn(tmp_path / "run", **faults)
    assert report["exit_code"] == 0
    assert all(report["done"][fault] > 10 for fault in faults), "the faults were not done"
    assert report["differing"] == 0
    assert report["answered"] == clean[0]["answered"]
    assert report["begun"] == clean[0]["begun"] == [1, 4, 7, 10]
    assert folder.episodes.read_bytes() == clean[1].episodes.read_bytes()
    assert folder.policy.read_bytes() == clean[1].policy.read_bytes()
    decided = Counter((decision.session, decision.seq) for _, decision in recorded(folder.messages, DECISION))
    assert max(decided.values()) == 1
    done = ", ".join(f"{report['done'][fault]} x {fault}" for fault in faults)
    observe(f"{done} in {report['answered']} decisions; the same bytes")


def test_faults_change_nothing_that_a_planner_learns(tmp_path):
    config = ROOT / "config" / "default.ini"
    clean, mistreated = learn(tmp_path / "clean", config), learn(tmp_path / "run", config, **FAULTS["all at once"])
    assert mistreated[0]["exit_code"] == mistreated[0]["differing"] == 0
    assert mistreated[1].episodes.read_bytes() == clean[1].episodes.read_bytes()
    assert mistreated[1].policy.read_bytes() == clean[1].policy.read_bytes()


def test_garbage_is_counted(tmp_path):
    report, folder = learn(tmp_path / "run", garbage=0.3)
    last = [status for _, status in recorded(folder.messages, STATUS) if status.process == status_t.CONTROLLER][-1]
    # a piece of garbage is two broken messages and one that is not finite; the last may come too late to be met
    least, most = report["garbage_met"], report["done"]["garbage"]
    assert least > 10
    assert least <= last.rejected_non_finite <= most
    assert 2 * least <= last.rejected_malformed <= 2 * most
