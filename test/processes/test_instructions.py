"""Decision and simulated step take no more instructions than are recorded in test/counts.txt."""

import shutil

import pytest

from limphome_lab import paths
from limphome_lab.measure import counts


@pytest.mark.parametrize("name", counts.COUNTED)
def test_no_more_instructions_than_recorded(name):
    if shutil.which("valgrind") is None:
        pytest.skip("there is no valgrind: install it")
    if "sanitize" in (paths.BUILD / "CMakeCache.txt").read_text():
        pytest.skip("sanitizers, whose instructions would be counted too")
    recorded, made_by = counts.read()
    allowed = counts.tolerance(made_by)
    lines, more = counts.compare({name: counts.COUNTED[name]()}, recorded, allowed)
    assert not more, "\n".join([*lines, counts.advice(allowed, made_by)])
