"""limphome-describe: what both programs understand of a robot file, as its JSON has it."""

import json
import subprocess

from limphome_lab import paths
from limphome_lab.ending import Ending


def options(packages):
    """Of each program; `packages`: folders for package://, separated by ':', or None."""
    return ["--packages", packages] if packages else []


def ask(file, packages=None):
    """(exit code, what is told of the file)"""
    command = [paths.program("describe"), "--json", *options(packages), file]
    result = subprocess.run(command, capture_output=True, text=True, errors="surrogateescape")
    if not result.stdout:
        raise Ending(result.stderr.strip() or f"{command[0]}: exit {result.returncode}")
    return result.returncode, json.loads(result.stdout)
