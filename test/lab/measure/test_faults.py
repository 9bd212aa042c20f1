"""The table of faults tells what its tests have shown, and nothing else."""

import json
import shutil
import subprocess
import sys

import pytest

from limphome_lab.paths import ROOT

TESTS = """
import pytest

fault = pytest.mark.fault("something", injected="somehow", expected="something else")

@pytest.fixture
def spoilt():
    yield
    raise RuntimeError("not undone")

@fault
@pytest.mark.parametrize("count", [3, 4])
def test_passes(observe, count):
    observe(f"{count} lost")
    observe("none missed")

@fault
def test_fails(observe):
    observe("too early")
    assert 1 == 2, "one is not two"

@fault
def test_is_skipped(observe):
    pytest.skip("no tools")

@fault
def test_observes_nothing(observe):
    pass

@fault
def test_is_spoilt(observe, spoilt):
    observe("all well")

def test_without_mark():
    assert False
"""
INJECT = """
import json, sys
from dataclasses import asdict
from limphome_lab.measure.faults import inject
json.dump([asdict(row) for row in inject(sys.argv[1], None, sys.stderr)], sys.stdout)
"""


@pytest.fixture(scope="module")
def rows(tmp_path_factory):
    folder = tmp_path_factory.mktemp("faults")
    shutil.copy(ROOT / "test" / "conftest.py", folder)
    (folder / "test_some.py").write_text(TESTS)
    result = subprocess.run([sys.executable, "-c", INJECT, folder], capture_output=True, text=True, cwd=folder)
    assert result.returncode == 0, result.stderr
    return {row["test"].partition("::")[2]: row for row in json.loads(result.stdout)}


def test_a_row_for_each_marked_test_and_parameter(rows):
    assert set(rows) == {
        "test_passes[3]",
        "test_passes[4]",
        "test_fails",
        "test_is_skipped",
        "test_observes_nothing",
        "test_is_spoilt",
    }


def test_what_was_observed(rows):
    row = rows["test_passes[4]"]
    assert row["fault"] == "something [4]" and row["injected"] == "somehow" and row["expected"] == "something else"
    assert row["passed"] and row["observed"] == "4 lost; none missed"


@pytest.mark.parametrize(
    "test, words",
    [
        ("test_fails", "one is not two"),
        ("test_is_skipped", "no tools"),
        ("test_observes_nothing", ""),
        ("test_is_spoilt", "not undone"),
    ],
)
def test_what_was_not_shown_is_lost(rows, test, words):
    assert not rows[test]["passed"] and words in rows[test]["observed"]
