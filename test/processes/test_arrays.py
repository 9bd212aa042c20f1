"""A learned policy as C: what `limphome-arrays` writes compiles without a word, and the example on an emulated board
decides by it what the controller decided."""

import shutil
import subprocess

import numpy as np
import pytest
from bus import settings

from conftest import ROOT, run_script
from limphome import planner_t, policy_t
from limphome_lab import paths
from limphome_lab.channels import COMMAND, STATE
from limphome_lab.ending import InputError
from limphome_lab.export import c_arrays
from limphome_lab.messages import recorded
from limphome_lab.runfolder import RunFolder

LEARNED = {"default": 10, "paper": 4}  # episodes of each experiment
DRIVEN = 2
ACTUATORS = 5
PAPERS_ROBOT = (  # capacities
    "LH_MAX_UNITS=50;LH_MAX_ACTUATORS=5;LH_MAX_ACTIONS=81;LH_MAX_LINKS=6;LH_MAX_SUPPORTS=5;LH_MAX_SHAPES=8;LH_MAX_PLANNED=4"
)
INCLUDE = """#include "policy.h"
#include "robot.h"
static lh_controller controller;
int main() {
    return lh_controller_init(&controller, &limphome_config, &limphome_robot, &limphome_controlled) != LH_OK ||
           lh_controller_keep_apart(&controller, &limphome_shapes) != LH_OK ||
           lh_controller_restore(&controller, &limphome_learned, limphome_episode) != LH_OK;
}
"""
WARNINGS = ["-Wall", "-Wextra", "-Werror", "-Wconversion"]


@pytest.fixture(scope="module", params=LEARNED)
def trained(request, tmp_path_factory):
    """Run folder of a planner, and of Q-learning."""
    out = tmp_path_factory.mktemp("arrays") / request.param
    episodes = ("--episodes", LEARNED[request.param], "--set", "episode.step_limit=200")
    run_script("train", "--config", f"config/{request.param}.ini", *episodes, "--out", out, "--quiet", cwd=ROOT)
    return RunFolder(out)


@pytest.fixture(scope="module")
def exported(trained):
    folder = trained.path / "c"
    assert [file.name for file in c_arrays.write(trained, folder)] == ["robot.h", "policy.h"]
    return folder


@pytest.fixture(scope="session")
def build(tmp_path_factory):
    """For the board: of another policy only the example is compiled anew."""
    return tmp_path_factory.mktemp("board")


def floats(text, name):
    """Numbers of the array or member of that name."""
    start = text.index(f".{name} = {{") + len(f".{name} = {{")
    return [np.float32(each.strip().rstrip("f")) for each in text[start : text.index("}", start)].split(",")[:-1]]


def test_numbers_come_back_with_their_bits(trained, exported):
    text = (exported / "policy.h").read_text()
    data = trained.policy.read_bytes()
    if trained.settings()["learner"]["kind"] == "planner":
        policy = planner_t.decode(data)
        assert floats(text, "cost") == list(policy.node_cost[: len(floats(text, "cost"))])
        assert floats(text, "width")[:3] == [np.float32(each) for each in policy.kernel_width]
    else:
        policy = policy_t.decode(data)
        used = policy.num_units
        assert floats(text, "weight") == [np.float32(each) for each in policy.weight[:used]]
        assert floats(text, "width") == [np.float32(each) for each in policy.width[:used]]
    assert f"limphome_episode = {policy.episode + 1};" in text


@pytest.mark.parametrize(
    "compiler", [("cc", "-std=c11", "-Wpedantic"), ("c++", "-std=c++17"), ("c++", "-std=c++20", "-Wpedantic")]
)
def test_they_compile_without_a_word_and_are_taken_up(exported, tmp_path, compiler):
    source = tmp_path / ("main.c" if compiler[0] == "cc" else "main.cpp")
    source.write_text(INCLUDE.replace("main()", "main(void)") if compiler[0] == "cc" else INCLUDE)
    library = paths.BUILD / "controller/limphome/liblimphome.a"
    program = tmp_path / "taken"
    command = [*compiler, *WARNINGS, "-I", exported, "-I", ROOT / "controller", source, library, "-o", program]
    result = subprocess.run(command, capture_output=True, text=True)
    assert (result.returncode, result.stderr) == (0, "")
    assert subprocess.run([program]).returncode == 0


def test_a_board_decides_as_the_controller_did(trained, exported, build, tmp_path):
    if not (shutil.which("arm-none-eabi-gcc") and shutil.which("qemu-system-arm")):
        pytest.skip("there is no gcc-arm-none-eabi or qemu-system-arm")
    drive = tmp_path / "drive"
    as_exported = settings("safety.monitor=on", "episode.step_limit=200", "episode.reset_every=50")
    options = ("--episodes", DRIVEN, *as_exported, *settings("randomisation.position_m=0"))
    run_script("evaluate", trained.path, *options, "--out", drive)
    states, velocities = driven(RunFolder(drive))
    assert len(states) > 20 and len({each.tobytes() for each in velocities}) > 1
    states.tofile(tmp_path / "states.bin")
    configure = ["cmake", "-S", ROOT / "examples/microcontroller", "-B", build, "-G", "Ninja"]
    configure += ["--toolchain", ROOT / "cmake/cortex-m4f.cmake", f"-DPOLICY={exported}", "-DCMAKE_BUILD_TYPE=Release"]
    subprocess.run([*configure, f"-DLIMPHOME_CAPACITIES={PAPERS_ROBOT}"], check=True, capture_output=True)
    subprocess.run(["cmake", "--build", build], check=True, capture_output=True)
    board = ["qemu-system-arm", "-machine", "mps2-an386", "-display", "none", "-monitor", "none", "-serial", "none"]
    semihosting = ["-semihosting-config", "enable=on,target=native"]
    subprocess.run([*board, *semihosting, "-kernel", build / "drive"], check=True, cwd=tmp_path, timeout=300)
    assert (tmp_path / "velocities.bin").read_bytes() == velocities.tobytes()


def driven(run):
    """What the controller was told in its sessions, as the board's states, and what it commanded; where it asked for a
    reset, rest."""
    commands, states = {}, {}
    for channel, message in recorded(run.messages, STATE, COMMAND):
        (states if channel == STATE else commands).setdefault((message.session, message.seq), message)
    told = [(key, state) for key, state in states.items() if state.reset_sender != 0][:-1]  # the last ends the run
    rows = [
        [
            *state.position,
            *state.orientation,
            *state.actuator_position[:ACTUATORS],
            *state.actuator_effort[:ACTUATORS],
            *(health == 1 for health in state.actuator_health[:ACTUATORS]),
        ]
        for _, state in told
    ]
    velocities = [commands[key].velocity[:ACTUATORS] if key in commands else [0.0] * ACTUATORS for key, _ in told]
    return np.array(rows, np.float32), np.array(velocities, np.float32)


def test_what_does_not_go_together_is_refused(trained, tmp_path):
    other = RunFolder(tmp_path / "other")
    other.path.mkdir()
    shutil.copy(trained.policy, other.policy)
    shutil.copy(trained.robot, other.robot)
    other.config.write_text(trained.config.read_text().replace("joint_speed = 0.3", "joint_speed = 0.2"))
    with pytest.raises(InputError, match="other actuators, speeds"):
        c_arrays.write(other, tmp_path / "c")
