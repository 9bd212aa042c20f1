"""Each room of limphome_lab uses the top and the rooms that the package's docstring names, and no other."""

import ast
import re
from pathlib import Path

import pytest

import limphome_lab

PACKAGE = Path(limphome_lab.__file__).parent
FILES = sorted(PACKAGE.rglob("*.py"))


def rooms():
    """{room: rooms it may use}, as the docstring has them."""
    rows = re.findall(r"^    (\w+)  .*  ([\w, -]+)$", limphome_lab.__doc__, re.MULTILINE)
    return {room: set(may_use.replace("-", "").replace(",", "").split()) for room, may_use in rows}


def room_of(module):
    """Of limphome_lab.ROOM.x; None for the top."""
    parts = module.split(".")
    return parts[1] if len(parts) > 1 and (PACKAGE / parts[1]).is_dir() else None


def imported(file):
    """Modules of limphome_lab that a file imports anywhere, as `limphome_lab.x.y`."""
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name.startswith("limphome_lab"))
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{file}: imports are absolute, so that this test sees them"
            if node.module.startswith("limphome_lab"):
                yield from (f"{node.module}.{alias.name}" for alias in node.names)


def test_every_room_is_named():
    folders = {file.parent.name for file in PACKAGE.glob("*/__init__.py")}
    assert folders == set(rooms()) != set()
    assert set.union(*rooms().values()) < folders


@pytest.mark.parametrize("file", FILES, ids=[str(file.relative_to(PACKAGE)) for file in FILES])
def test_imports_stay_within_the_rooms(file):
    own = room_of(".".join(["limphome_lab", *file.relative_to(PACKAGE).parts]))
    allowed = {None, own} | rooms().get(own, set()) if own else {None}
    assert {room_of(module) for module in imported(file)} <= allowed


def test_no_room_uses_one_that_uses_it():
    assert all(room not in rooms()[used] for room in rooms() for used in rooms()[room])
