"""Makes the package limphome_lab and the generated messages importable, here and in what the tests start."""

import os
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
BUILD = Path(os.environ.get("LIMPHOME_BUILD", ROOT / "build"))
PACKAGES = [str(ROOT / "python"), str(BUILD / "python")]
sys.path[:0] = PACKAGES
os.environ["PYTHONPATH"] = os.pathsep.join(PACKAGES)


def pytest_configure(config):
    config.addinivalue_line("markers", "fault(what, injected, expected): a row of the table of faults")


@pytest.fixture
def observe():
    """Takes what was observed, a short text with the figures."""
    return print
