"""limphome-instrument: what a script cannot mean is refused by the words it said."""

import subprocess

import pytest

from conftest import ROOT
from limphome_lab import paths


@pytest.mark.parametrize("line", ["reset -1", "reset 1e30", "reset 0 1", "advance", "advance soon", "fly 1"])
def test_line_that_is_none_is_refused(line):
    words = [paths.program("instrument"), "--config", paths.CONFIG / "paper.ini"]
    words += ["--robot", ROOT / "config" / "crawler.urdf"]
    result = subprocess.run([*map(str, words)], input=f"{line}\nsense\n", capture_output=True, text=True, timeout=20)
    assert result.returncode == 2
    assert result.stdout == ""
    assert line in result.stderr
