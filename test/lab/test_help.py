"""--help of every script answers on a bare machine, with a Python or without: nothing is installed, built or made."""

import re
import shutil
import subprocess
import sys

import pytest

from limphome_lab.paths import ROOT

SCRIPTS = (
    "bench",
    "clean",
    "compare",
    "counts",
    "diagnose",
    "evaluate",
    "export",
    "faults",
    "growth",
    "launch",
    "plot",
    "replay",
    "results",
    "robot",
    "setup",
    "site",
    "soak",
    "spy",
    "study",
    "test",
    "train",
    "validate",
    "verify",
    "view",
)
TOOLS = ("bash", "dirname", "env", "readlink", "sed")  # all of a bare Debian that a help needs


@pytest.fixture(scope="module")
def clone(tmp_path_factory):
    """The tree as it is after a clone."""
    folder = tmp_path_factory.mktemp("clone") / "limphome"
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True)
    for name in listed.stdout.split("\0"):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, folder / name)
    return folder


@pytest.fixture(params=["with Python", "without Python"])
def machine(request, tmp_path):
    """Environment of a machine with few programs, of which one may be a Python without any packages."""
    folder = tmp_path / "bin"
    folder.mkdir()
    for tool in TOOLS:
        (folder / tool).symlink_to(shutil.which(tool))
    if request.param == "with Python":
        python = folder / "python3"
        python.write_text(f'#!{shutil.which("bash")}\nexec {sys.executable} -S "$@"\n')
        python.chmod(0o755)
    return {"PATH": str(folder), "HOME": str(tmp_path)}


def ask(clone, script, environment):
    command = [clone / "scripts" / script, "--help"]
    result = subprocess.run(command, env=environment, cwd=clone, capture_output=True, text=True, timeout=60)
    assert result.returncode == 0, result.stderr
    assert result.stderr == ""
    return result.stdout


def test_every_script_is_asked():
    heads = {file.name for file in (ROOT / "scripts").iterdir() if file.read_text().startswith("#!")}
    assert heads == set(SCRIPTS)


@pytest.mark.parametrize("script", SCRIPTS)
def test_help_shows_usage_and_an_example_and_makes_nothing(clone, machine, script):
    before = sorted(clone.rglob("*"))
    text = ask(clone, script, machine)
    assert re.search(rf"^usage: scripts/{script}\b", text, re.MULTILINE | re.IGNORECASE)
    assert re.search(rf"^example: .*\bscripts/{script}\b", text, re.MULTILINE | re.IGNORECASE)
    assert sorted(clone.rglob("*")) == before


@pytest.mark.parametrize("script", [name for name in SCRIPTS if "\ntool=" in (ROOT / "scripts" / name).read_text()])
def test_head_of_the_script_names_the_options_of_its_tool(clone, script):
    def options(text):
        return set(re.findall(r"--\w+", text)) - {"--help"}

    head = (clone / "scripts" / script).read_text().partition("\ntool=")[0]
    result = subprocess.run([clone / "scripts" / script, "--help"], capture_output=True, text=True, check=True)
    assert options(result.stdout) == options(head)
