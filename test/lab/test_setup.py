"""scripts/setup called by sudo, where apt alone runs as root; and in a tree that is somebody else's."""

import getpass
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pytest

from limphome_lab.paths import ROOT

NOBODY = 65534
SETUP = (ROOT / "scripts" / "setup").read_text().replace("\\\n", "")
TARGETS = re.findall(r"^    build_targets (.*)$", SETUP, re.MULTILINE)[0].split()


@pytest.mark.fault(
    "scripts/setup called by sudo",
    injected="SUDO_USER is set, and another program stands in for sudo",
    expected="pip and builds are handed back to that user, with the same arguments",
)
@pytest.mark.skipif(os.geteuid() != 0, reason="root alone can be told to be somebody else")
def test_what_sudo_has_started_goes_on_as_who_called_it(tmp_path, observe):
    sudo = tmp_path / "sudo"
    sudo.write_text('#!/bin/sh\necho "$@"\nexit 7\n')
    sudo.chmod(0o755)
    environment = {**os.environ, "SUDO_USER": "somebody", "PATH": f"{tmp_path}:{os.environ['PATH']}"}
    script = ROOT / "scripts" / "setup"
    result = subprocess.run([script, "a", "b c"], env=environment, capture_output=True, text=True, timeout=300)
    observe(result.stdout.strip().replace(str(ROOT), "."))
    assert result.returncode == 7, result.stderr
    assert result.stdout == f"-u somebody --preserve-env=LIMPHOME_BUILD -- {script} a b c\n"


@pytest.fixture
def tree():
    """A tree with what setup reads, all of it ready; the programs that it calls tell their names and fail."""
    with tempfile.TemporaryDirectory() as folder:  # pytest's own are for this user's eyes alone
        tree = Path(folder) / "tree"
        for name in ("scripts/setup", "CMakeLists.txt", "CMakePresets.json"):
            (tree / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, tree / name)
        for name in ("cmake", "config", "controller", "lcmtypes", "pair", "robot", "simulator"):
            (tree / name).mkdir()
        (tree / "scripts" / "packages.txt").write_text("dpkg\n")
        (tree / "scripts" / "requirements.txt").write_text("nothing\n")
        place(tree / ".venv" / "bin" / "python", "exit 7")
        shutil.copy(tree / "scripts" / "requirements.txt", tree / ".venv")
        for name in ("cmake", "ninja", "git"):
            place(Path(folder) / "bin" / name, f"echo called {name}; touch {tree}/build/made")
        (tree / "build" / "built").mkdir(parents=True)
        for name in TARGETS:
            (tree / "build" / "built" / name).touch()
        os.chmod(folder, 0o755)
        yield tree


def place(program, code):
    program.parent.mkdir(parents=True, exist_ok=True)
    program.write_text(f"#!/bin/sh\n{code}\n")
    program.chmod(0o755)


def set_up(tree, by_another):
    """Calls setup as the owner or as somebody who may read all and write nothing."""
    options = {"user": NOBODY} if by_another and os.geteuid() == 0 else {}
    if by_another and not options:
        subprocess.run(["chmod", "-R", "a-w", tree], check=True)
    try:
        environment = {"PATH": f"{tree.parent}/bin:{os.environ['PATH']}", "HOME": "/nonexistent"}
        command = [tree / "scripts" / "setup"]
        return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60, **options)
    finally:
        subprocess.run(["chmod", "-R", "u+w", tree], check=True)


def test_what_another_user_has_set_up_is_used_as_it_is(tree):
    result = set_up(tree, by_another=True)
    assert (result.returncode, result.stdout, result.stderr) == (0, "", "")
    assert "called ninja" in set_up(tree, by_another=False).stderr


@pytest.mark.parametrize("stale", ["environment", "source", "target"])
def test_what_another_user_has_set_up_and_is_old_is_told(tree, stale):
    if stale == "environment":
        (tree / "scripts" / "requirements.txt").write_text("more\n")
    elif stale == "source":
        (tree / "controller" / "new.c").touch()
        later = time.time() + 10  # the clock of files has ticks
        os.utime(tree / "controller" / "new.c", (later, later))
    else:
        (tree / "build" / "built" / TARGETS[0]).unlink()
    result = set_up(tree, by_another=True)
    assert result.returncode == 1
    assert f"belongs to {getpass.getuser()}, and " in result.stderr
    assert "either run scripts/setup once as" in result.stderr
    assert "called" not in result.stdout + result.stderr


@pytest.mark.skipif(os.geteuid() != 0, reason="root alone can make files that are another's")
def test_what_root_makes_in_another_users_tree_is_theirs(tree):
    subprocess.run(["chown", "-R", str(NOBODY), tree], check=True)
    set_up(tree, by_another=False)
    assert (tree / "build" / "made").stat().st_uid == NOBODY


def test_runs_in_another_users_tree_go_to_ones_home(tmp_path):
    code = (
        "from limphome_lab import paths; paths.os.access = lambda *_: False; importlib.reload(paths); print(paths.RUNS)"
    )
    environment = {**os.environ, "HOME": str(tmp_path)}
    result = subprocess.run(
        [sys.executable, "-c", f"import importlib; {code}"], env=environment, capture_output=True, text=True, check=True
    )
    assert result.stdout.strip() == str(tmp_path / "limphome" / "runs")
