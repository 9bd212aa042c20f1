"""What pip installs: each file has its hash, and the versions are those asked for."""

import re
import tomllib

import pytest

from limphome_lab.paths import ROOT

SCRIPTS = ROOT / "scripts"
LOCKED = sorted(SCRIPTS.glob("requirements*.txt"))


def asked_for():
    """The pins that people write."""
    lines = [line for file in SCRIPTS.glob("*.in") for line in file.read_text().splitlines()]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    sets = project["project"]["optional-dependencies"] | project["dependency-groups"]
    lines += [package for packages in sets.values() for package in packages]
    return [line for line in lines if line and not line.startswith("#")]


def locked(file):
    """{name==version: [hash]}"""
    entries = re.sub(r" \\\n", "", file.read_text()).splitlines()
    words = (entry.split() for entry in entries if not entry.startswith("#"))
    return {pin: hashes for pin, *hashes in words}


@pytest.mark.parametrize("file", LOCKED, ids=lambda file: file.name)
def test_each_package_is_pinned_with_hashes(file):
    entries = locked(file)
    assert entries
    for pin, hashes in entries.items():
        assert re.fullmatch(r"[a-z0-9-]+==[\w.]+", pin)
        assert hashes and all(re.fullmatch(r"--hash=sha256:[0-9a-f]{64}", each) for each in hashes)


def test_what_is_asked_for_is_locked():
    assert set(asked_for()) <= {pin for file in LOCKED for pin in locked(file)}


def test_the_environment_has_one_version_of_each():
    versions = {}
    for file in LOCKED:
        for pin in locked(file):
            name, version = pin.split("==")
            assert versions.setdefault(name, version) == version
