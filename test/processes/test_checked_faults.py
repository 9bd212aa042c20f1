"""Faults that are injected inside the controller's own test programs; a row of the table for each."""

import os
import re
import subprocess

import pytest

from conftest import TIME_LIMIT_S
from limphome_lab import paths

# (test program, fault, how it is injected, what is right)
PROGRAMS = [
    (
        "write_cut",
        "every write is cut",
        "the process dies at any byte of any file (RLIMIT_FSIZE), at some 120 places",
        "each is gone on with, and ends as one that never died",
    ),
    (
        "learned",
        "a bit has turned in what was learned",
        "every bit of a policy and a checkpoint of Q-learning, bits all over those of a planner",
        "all are refused",
    ),
    (
        "recording",
        "a recording is torn, damaged or too long",
        "cut at every byte; a byte turned; a full device; beyond its limit",
        "it is cut to whole events of whole episodes, told, or thinned",
    ),
    (
        "run_folder",
        "checkpoint, table and recording do not agree",
        "each of them cut or missing; stray files; another controller",
        "the newest place where they agree is taken, or nothing is touched",
    ),
    (
        "files",
        "the disk fails, or a signal comes while it is waited for",
        "fsync fails with EIO, with EINTR",
        "told, and the old file stays; waited for again",
    ),
]


@pytest.mark.parametrize(
    "program",
    [
        pytest.param(name, id=name, marks=pytest.mark.fault(fault, injected=injected, expected=expected))
        for name, fault, injected, expected in PROGRAMS
    ],
)
def test_program(program, observe):
    file = paths.BUILD / "bin" / f"test_{program}"
    if not file.exists():
        pytest.skip("the C tests are not built")
    result = subprocess.run([file], capture_output=True, text=True, timeout=TIME_LIMIT_S, env=os.environ)
    summary = re.search(r"(\d+)%: Checks: (\d+), Failures: (\d+), Errors: (\d+)", result.stdout)
    assert result.returncode == 0, result.stdout + result.stderr
    cuts = re.search(r"\d+ cuts", result.stdout)
    observe(f"{summary[2]} cases, 0 failures" + (f", {cuts[0]}" if cuts else ""))
