"""`pip install .` gives limphome_lab, the message types and the commands, which find what `cmake --install` has put."""

import shutil
import subprocess
import sys
import sysconfig
import tomllib
import venv
from pathlib import Path

import pytest

from limphome_lab import network, paths, runfolder

HERE = Path(sys.executable).parent  # has lcm-gen of the package lcm, as pip's own build environment would

PROJECT = tomllib.loads((paths.ROOT / "pyproject.toml").read_text())["project"]
COMMANDS = [name.removeprefix("limphome-") for name in PROJECT["scripts"]]


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """Folder of the commands in a fresh environment, which borrows only the packages that ours depends on."""
    folder = tmp_path_factory.mktemp("installed")
    offline = ["--quiet", "--no-deps", "--no-index", "--disable-pip-version-check"]
    wheel = [sys.executable, "-m", "pip", "wheel", *offline, "--no-build-isolation", "-w", folder, paths.ROOT]
    subprocess.run(wheel, check=True, env={"PATH": f"{HERE}:/usr/bin:/bin", "HOME": str(folder)})
    venv.create(folder / "venv")
    python = folder / "venv" / "bin" / "python"
    pip = [sys.executable, "-m", "pip", "--python", python]
    subprocess.run([*pip, "install", *offline, *folder.glob("*.whl")], check=True)
    purelib = "import sysconfig; print(sysconfig.get_path('purelib'))"
    site = subprocess.run([python, "-c", purelib], check=True, capture_output=True, text=True).stdout.strip()
    (Path(site) / "dependencies.pth").write_text(sysconfig.get_path("purelib") + "\n")
    return python.parent


@pytest.fixture
def prefix(tmp_path):
    """Programs and files where `cmake --install` puts them."""
    (tmp_path / "prefix" / "bin").mkdir(parents=True)
    for name in ("controller", "simulator", "pair", "describe"):
        shutil.copy(paths.program(name), tmp_path / "prefix" / "bin")
    shutil.copytree(paths.library("environment").parent, tmp_path / "prefix" / "lib" / "limphome")
    shutil.copytree(paths.CONFIG, tmp_path / "prefix" / "share" / "limphome" / "config")
    return tmp_path / "prefix"


def run(folder, command, *programs):
    places = [*map(str, programs), "/usr/bin", "/bin", "/usr/sbin", "/sbin"]
    environment = {"PATH": ":".join(places), "HOME": str(folder)}
    return subprocess.run(list(map(str, command)), cwd=folder, env=environment, capture_output=True, text=True)


def test_package_and_messages_can_be_imported(installed, tmp_path):
    code = "import limphome, limphome_lab.messages as m; print(limphome.robot_state_t in m.TYPES.values(), m.__file__)"
    result = run(tmp_path, [installed / "python", "-c", code])
    assert result.stdout.startswith(f"True {installed.parent}"), result.stderr


@pytest.mark.parametrize("name", COMMANDS)
def test_commands_go_by_their_own_names(installed, tmp_path, name):
    result = run(tmp_path, [installed / f"limphome-{name}", "--help"])
    assert result.returncode == 0, result.stderr
    assert result.stdout.startswith(f"usage: limphome-{name} ")
    assert f"example: limphome-{name} " in result.stdout
    assert "scripts/" not in result.stdout


@pytest.mark.skipif(network.private_prefix() is None, reason="network namespaces are not permitted here")
def test_training_and_evaluation_without_the_source_tree(installed, prefix, tmp_path):
    words = ["--episodes", 2, "--set", "episode.step_limit=10", "--out", "mine", "--quiet"]
    trained = run(tmp_path, [installed / "limphome-train", *words], prefix / "bin")
    assert trained.returncode == 0, trained.stderr
    folder = runfolder.RunFolder(tmp_path / "mine")
    assert len(folder.read_episodes()) == 2
    assert (folder.figures / "fig8_reward.png").exists()
    assert run(tmp_path, [installed / "limphome-evaluate", "mine", "--episodes", 1], prefix / "bin").returncode == 0


def test_environment_without_the_source_tree(installed, prefix, tmp_path):
    code = """import gymnasium, limphome_lab.gym, importlib.resources as files
env = gymnasium.make("limphome/LimpHome-v0", set={"episode.goal_distance_m": 3})
print(env.reset(seed=1)[1]["goal_distance"], files.files("limphome_lab").joinpath("py.typed").is_file())
env.close()"""
    result = run(tmp_path, [installed / "python", "-c", code], prefix / "bin")
    assert result.stdout == "3.0 True\n", result.stderr
    (prefix / "lib" / "limphome" / "liblimphome_environment.so").unlink()
    result = run(tmp_path, [installed / "python", "-c", code], prefix / "bin")
    assert "liblimphome_environment.so is missing" in result.stderr


def test_programs_that_are_nowhere_are_told(installed, tmp_path):
    result = run(tmp_path, [installed / "limphome-train"])
    assert result.returncode == 1
    assert "limphome-controller is neither in" in result.stderr
    assert "Traceback" not in result.stderr
    assert not (tmp_path / "runs").exists()
