"""Channels have one name for C and C++, one for Python, and the same on the page of the protocol."""

import re
import subprocess

import pytest

from limphome_lab import channels
from limphome_lab.messages import TYPES
from limphome_lab.paths import ROOT

HEADER = ROOT / "lcmtypes" / "limphome_channels.h"
PYTHON = ROOT / "python" / "limphome_lab" / "channels.py"
NAMES = {name: value for name, value in vars(channels).items() if name.isupper()}
LITERAL = re.compile(r"""["']LIMPHOME_(?:{})\b""".format("|".join(NAMES)))


def test_header_has_the_same():
    defined = re.findall(r'^#define LIMPHOME_CHANNEL_(\w+) "(\w+)"$', HEADER.read_text(), re.MULTILINE)
    assert dict(defined) == NAMES != {}


def test_page_tells_the_same_with_the_types():
    rows = re.findall(r"^\| (LIMPHOME_\w+) \| (\w+_t) \|", (ROOT / "docs" / "protocol.md").read_text(), re.MULTILINE)
    assert dict(rows) == {channel: message.__name__ for channel, message in TYPES.items()}
    assert set(TYPES) == set(NAMES.values())


@pytest.mark.parametrize("pattern", ["*.c", "*.h", "*.cpp", "*.py"])
def test_no_code_spells_a_channel_itself(pattern):
    listed = subprocess.run(["git", "ls-files", "-z", pattern], cwd=ROOT, capture_output=True, text=True, check=True)
    files = [ROOT / name for name in listed.stdout.split("\0") if name]
    assert files
    spelled = [file for file in files if file.exists() and LITERAL.search(file.read_text())]
    assert [file for file in spelled if file not in (HEADER, PYTHON)] == []
