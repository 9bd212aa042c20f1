"""limphome-describe: what both programs understand of a robot file, as its JSON has it."""

import json
import re
import subprocess

from limphome_lab import paths
from limphome_lab.ending import Ending


def options(packages):
    """Of each program; `packages`: folders for package://, separated by ':', or None."""
    return ["--packages", packages] if packages else []


def ask(file, packages=None):
    """(exit code, what is told of the file)"""
    command = [paths.program("describe"), "--json", *options(packages), file]
    result = subprocess.run(command, capture_output=True, text=True)
    if not result.stdout:
        raise Ending(result.stderr.strip() or f"{command[0]}: exit {result.returncode}")
    return result.returncode, json.loads(result.stdout)


def meshes(file, packages=None):
    """{name: path} of the meshes that the programs read for a robot file, by their names in it."""
    text = file.read_text(errors="replace")
    if "<mesh" not in text:
        return {}
    names = sorted(set(re.findall(r"""filename\s*=\s*["']([^"']+)["']""", text)), key=len)
    _, told = ask(file, packages)
    return {name: path for path in told["meshes"] for name in names if _is_of(path, name)}


def copy_name(name):
    """Of the copy of a mesh beside a robot file, which is found before any other: as in robot/mesh_path.h."""
    return re.sub(r"[^A-Za-z0-9.-]", "_", name)


def _is_of(path, name):
    """Whether a mesh's path is where its name can have led: package://PACKAGE/REST is PACKAGE/REST or REST."""
    place = name.partition("://")[2] or name
    places = (place, place.partition("/")[2], copy_name(name))
    return any(path.endswith(f"/{place.lstrip('/')}") for place in places if place)
