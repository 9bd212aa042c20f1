"""Renews the hashes: .venv/bin/python scripts/pin.py

Writes requirements*.txt beside it, from which pip installs nothing but files with the hashes told there: all that the
packages of requirements.in and of each set in pyproject.toml (optional-dependencies and dependency-groups) need, in the
versions that pip chooses today, with the hashes of all files of those versions, for any processor and Python. All sets
share an environment. To take a newer version of a package, change its line and run this; then run scripts/test.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import tomllib
import urllib.request
from pathlib import Path

from pip._internal.models.index import PyPI

HERE = Path(__file__).resolve().parent
INDEX = os.environ.get("PIP_INDEX_URL", PyPI.simple_url)


def lines_of(file):
    return [line for line in (HERE / file).read_text().splitlines() if line and not line.startswith("#")]


def resolve(packages, earlier):
    """{name: version} of all that `packages` need, beside those of `earlier`."""
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as constraints:
        constraints.write("".join(f"{name}=={version}\n" for name, version in earlier.items()))
        constraints.flush()
        pip = [sys.executable, "-m", "pip", "install", "--quiet", "--dry-run", "--ignore-installed", "--report", "-"]
        report = subprocess.run([*pip, "-c", constraints.name, *packages], check=True, stdout=subprocess.PIPE).stdout
    chosen = (install["metadata"] for install in json.loads(report)["install"])
    return {re.sub(r"[-_.]+", "-", each["name"]).lower(): each["version"] for each in chosen}


def hashes(name, version):
    """SHA-256 of each file of a version."""
    request = urllib.request.Request(f"{INDEX}/{name}/", headers={"Accept": "application/vnd.pypi.simple.v1+json"})
    with urllib.request.urlopen(request) as answer:
        files = json.load(answer)["files"]
    stem = re.compile(
        name.replace("-", "[-_.]+") + "-" + re.escape(version) + r"(-.*\.whl|\.tar\.gz|\.zip)", re.IGNORECASE
    )
    return sorted(file["hashes"]["sha256"] for file in files if stem.fullmatch(file["filename"]) and not file["yanked"])


def write(file, packages, earlier):
    versions = resolve(packages, earlier)
    with open(HERE / file, "w") as out:
        out.write("# Written by scripts/pin.py, which tells how to renew it.\n")
        for name, version in sorted(versions.items()):
            known = hashes(name, version)
            assert known, f"{name} {version}: no files"
            out.write(f"{name}=={version}" + "".join(f" \\\n    --hash=sha256:{each}" for each in known) + "\n")
    return versions


def main():
    project = tomllib.loads((HERE.parent / "pyproject.toml").read_text())
    base = lines_of("requirements.in")
    sets = project["project"]["optional-dependencies"] | project["dependency-groups"]
    together = resolve([*base, *(package for packages in sets.values() for package in packages)], {})
    write("requirements.txt", base, together)
    for name, packages in sets.items():
        write(f"requirements-{name}.txt", packages, together)


if __name__ == "__main__":
    main()
