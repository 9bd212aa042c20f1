#!/usr/bin/env python3
"""skipped.py FILE...: the tests that did not run, with the reason, from the JUnit files of ctest and pytest."""

import sys
import xml.etree.ElementTree as ET
from pathlib import Path


def reason(test):
    """What pytest says; of ctest's, what GoogleTest says after "Skipped", or the program's last line."""
    skipped = test.find("skipped")
    if test.get("status") is None:  # pytest's
        return skipped.get("message")
    lines = (test.findtext("system-out") or "").strip().splitlines()
    said = [lines[k + 1] for k, line in enumerate(lines[:-1]) if line.endswith(": Skipped")]
    return [*said, *lines[-1:], "disabled by CMake: a tool is missing"][0]


for file in map(Path, sys.argv[1:]):
    for test in ET.parse(file).iter("testcase"):
        if test.find("skipped") is not None or test.get("status") in ("notrun", "disabled"):
            print(f"{file.stem}: {test.get('classname')} {test.get('name')}: {reason(test)}")
