"""What is learned does not change unnoticed: SHA-256 of what runs of 40 short episodes left behind.

A change of recorded.json says that the learner, the task or the physics has changed, and is a decision of its own. The
library gives the same bits everywhere; the simulator's depend on the C library's sine, which has two forms on x86-64.
"""

import hashlib
import json
import platform
from pathlib import Path

import pytest

from conftest import ROOT, run_script

RECORDED = json.loads((Path(__file__).parent / "recorded.json").read_text())


def has_fused_multiply_add():
    return platform.machine() == "x86_64" and " fma " in Path("/proc/cpuinfo").read_text()


def learned_fields(policy):
    """Of an encoded policy, without what tells of the message alone: the type's fingerprint, and the checksum."""
    return policy[8:-4]


@pytest.mark.skipif(not has_fused_multiply_add(), reason="recorded on x86-64 with FMA")
@pytest.mark.parametrize("experiment", RECORDED)
def test_what_is_learned_is_what_was_recorded(experiment, tmp_path):
    run_script(
        "train",
        "--one-process",  # the bytes of two, and sooner there
        "--config",
        ROOT / "config" / f"{experiment}.ini",
        "--episodes",
        40,
        "--set",
        "episode.step_limit=200",
        "--out",
        tmp_path / "run",
        "--quiet",
    )
    contents = {
        "policy.lcm": learned_fields((tmp_path / "run" / "policy.lcm").read_bytes()),
        "episodes.csv": (tmp_path / "run" / "episodes.csv").read_bytes(),
    }
    found = {name: hashlib.sha256(content).hexdigest() for name, content in contents.items()}
    assert found == RECORDED[experiment]
