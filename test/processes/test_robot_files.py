"""Both programs take a robot file alike: the same robot, or the same refusal in the same words."""

import json
import os
import shutil
import signal
import subprocess

import pytest

from conftest import ROOT, SMOKE, run_script, train
from limphome_lab import paths

GOOD = (ROOT / "config" / "crawler.urdf").read_text()
BOX = '<box size="1.0 0.80 0.86"/></geometry></collision>'
ELBOW = '<sphere radius="0.08"/></geometry></collision>'
BOLT = (
    '<link name="bolt"><inertial><mass value="2"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/>'
    '</inertial>{shape}</link><joint name="bolt" type="{type}"><parent link="{parent}"/><child link="bolt"/>{more}'
    "</joint><limphome>"
)
# another root, below or above the base
FRAME = (
    '<link name="foot"/><joint name="foot" type="fixed"><parent link="foot"/><child link="base"/>'
    '<origin xyz="0 0 {height}"/></joint><link name="base">'
)


def bolt(parent="base", type="fixed", more="", shape=""):
    """A link more."""
    return ("<limphome>", BOLT.format(parent=parent, type=type, more=more, shape=shape))


def sprocket_with(shape):
    return ('<link name="left_sprocket">', f'<link name="left_sprocket"><collision>{shape}</collision>')


# (name, what stands in config/crawler.urdf, what stands there now, words of the refusal)
REFUSED = [
    ("cut short", "</robot>", "", "not XML"),
    ("a link joined to itself", *bolt(parent="bolt"), '<joint name="bolt">: link bolt would hang on itself'),
    ("a loop", '<parent link="upper_body"/>', '<parent link="arm"/>', "closes a loop: boom on arm"),
    ("two roots", "<limphome>", '<link name="lost"/><limphome>', '<link name="lost">: hangs on no joint'),
    ("two parents", '<child link="arm"/>', '<child link="upper_body"/>', "hangs on joint swing already"),
    ("commas in a shape", BOX, BOX.replace("1.0 0.80 0.86", "1,0 0,8 0,86"), '<box size="1,0 0,8 0,86">: must be 3'),
    ("two numbers in a shape", BOX, BOX.replace("1.0 0.80 0.86", "1 0.8"), '<box size="1 0.8">: must be 3 numbers'),
    ("a shape that is unknown", ELBOW, ELBOW.replace("sphere", "capsule"), '<capsule radius="0.08">: unknown shape'),
    ("commas in an origin", 'xyz="0.55 0 0"', 'xyz="0,55 0 0"', '<origin xyz="0,55 0 0">: must be 3 numbers'),
    ("two masses", '<mass value="350"/>', '<mass value="350"/><mass value="1"/>', '<mass value="1">: is given twice'),
    ("two origins", '<origin xyz="0 0 0.50"/>', '<origin xyz="0 0 0.50"/><origin/>', "<origin>: is given twice"),
    ("degrees", 'lower="-2.6" upper="2.6"', 'lower="-150" upper="150"', "look like degrees; must be in radians"),
    ("lower above upper", 'lower="-2.6" upper="2.6"', 'lower="2.6" upper="-2.6"', "lower 2.6 must be below upper -2.6"),
    ("home outside the limits", 'home="0.6"', 'home="1.6"', '<arm home="1.6">: must lie within the limits'),
    ("an inertia that no body has", 'ixx="30"', 'ixx="300"', "which no body has"),
    ("grams for kilograms", 'mass value="350"', 'mass value="350000"', '<mass value="350000">: would be'),
    ("no tip", '<tip link="arm" xyz="0.8 0 0" radius="0.08"/>', "", "has no <tip>"),
    ("no width", 'width="0.30" radius="0.18"/>', 'radius="0.18"/>', "needs width"),
    ("crawlers at two heights", 'xyz="0 0.475 0.18" l', 'xyz="0 0.475 0.3" l', "stands 0.12 m higher than the right"),
    ("left and right", 'xyz="0 0.475 0.18" l', 'xyz="0 -0.9 0.18" l', "the left one must come first"),
    (
        "a track that turns with its sprocket",
        *sprocket_with('<geometry><box size="1.6 0.3 0.36"/></geometry>'),
        "turns with the sprocket of a crawler and reaches beyond",
    ),
    (
        "a hull that carries the robot",
        *bolt(shape='<collision><geometry><box size="1 0.5 0.1"/></geometry></collision>'),
        "reaches 0.05 m below the ground on which the crawlers stand",
    ),
    (
        "an arm that follows",
        'name="boom" type="revolute">',
        'name="boom" type="revolute"><mimic joint="swing"/>',
        "<mimic",
    ),
    (
        "a mesh that is not there",
        ELBOW,
        '<mesh filename="package://a/b.stl"/></geometry></collision>',
        "cannot be found",
    ),
    ("an entity", '<robot name="crawler">', '<!DOCTYPE r [<!ENTITY a "b">]><robot>', "entities are refused"),
    ("xacro", "<limphome>", '<xacro:include filename="a"/><limphome>', "is xacro, not URDF"),
]

# (name, what stands in config/crawler.urdf, what stands there now, words of the notice or None)
ACCEPTED = [
    ("as it is", "", "", None),
    ("a zero axis that means nothing", *bolt(more='<axis xyz="0 0 0"/>'), None),
    (
        "a root without mass",
        '<link name="base">',
        FRAME.format(height=0),
        None,
    ),
    (
        "a base frame in the air",
        '<link name="base">',
        FRAME.format(height=-0.2),
        "the body frame, on the ground midway between the crawlers, lies at (0 0 -0.2) m",
    ),
    ("a gripper", *bolt(parent="arm", type="prismatic"), '<joint name="bolt">: moves, but is no actuator'),
    (
        "a continuous arm",
        'name="swing" type="revolute"',
        'name="swing" type="continuous"',
        "limited to -3.142 to 3.142",
    ),
    (
        "a track as a box",
        *sprocket_with('<origin xyz="0.62 0 0"/><geometry><box size="1.6 0.3 0.36"/></geometry>'),
        "<collision>: lies within the left crawler; left out",
    ),
    ("what others add", "<limphome>", '<gazebo/><transmission/><a:b xmlns:a="c"/><limphome>', None),
]


def check(program, robot):
    """(exit code, what a program says of a robot file)"""
    command = [paths.program(program), "--config", SMOKE, "--robot", robot, "--check"]
    result = subprocess.run(command, capture_output=True, text=True, timeout=30)
    assert result.stdout == ""
    return result.returncode, result.stderr


def write(folder, before, after):
    assert before in GOOD
    file = folder / "robot.urdf"
    file.write_text(GOOD.replace(before, after, 1))
    return file


@pytest.mark.parametrize(
    "before, after, words",
    [
        pytest.param(
            *case[1:],
            id=case[0],
            marks=pytest.mark.fault(
                "a robot file that is no robot",
                injected="an edit of config/crawler.urdf",
                expected="both programs refuse it with the same words, naming line and element",
            ),
        )
        for case in REFUSED
    ],
)
def test_both_refuse(tmp_path, before, after, words, observe):
    robot = write(tmp_path, before, after)
    verdict = check("controller", robot)
    assert verdict == check("simulator", robot)
    code, text = verdict
    assert code == 2 and words in text, text
    for line in text.splitlines():
        assert line.startswith(f"{robot}:"), line
    assert [file.name for file in tmp_path.iterdir()] == ["robot.urdf"]
    observe(text.splitlines()[0].replace(f"{tmp_path}/", ""))


@pytest.mark.parametrize("before, after, words", [case[1:] for case in ACCEPTED], ids=[case[0] for case in ACCEPTED])
def test_both_accept(tmp_path, before, after, words):
    robot = write(tmp_path, before, after)
    verdict = check("controller", robot)
    assert verdict == check("simulator", robot)
    code, text = verdict
    assert code == 0, text
    assert words in text if words else text == ""


def test_all_faults_are_told_but_not_without_end(tmp_path):
    many = "".join(f'<link name="l{i}"><inertial><mass value="x"/></inertial></link>' for i in range(30))
    robot = write(tmp_path, "<limphome>", f"{many}<limphome>")
    code, text = check("controller", robot)
    lines = text.splitlines()
    assert code == 2 and len(lines) == 21
    assert lines[-1].startswith(f"{robot}: and ") and lines[-1].endswith(" more")


def drive(robot, *options):
    """Positions after standing for a second and after driving for 4 s at 0.3 m/s."""
    command = [paths.program("instrument"), "--robot", robot, "--set", "failure.actuator=none", *options]
    orders = "sense\nadvance 1\nsense\ncommand 0.3 0.3\nadvance 4\nsense\n"
    result = subprocess.run(command, input=orders, capture_output=True, text=True, timeout=60)
    assert result.returncode == 0, result.stderr
    return [json.loads(line)["position"] for line in result.stdout.splitlines()]


@pytest.mark.parametrize("height", [-0.2, 0, 0.3])
def test_it_stands_on_its_crawlers_wherever_its_base_frame_lies(tmp_path, height):
    robot = write(tmp_path, '<link name="base">', FRAME.format(height=height))
    start, rested, driven = drive(robot)
    assert abs(start[2]) < 0.005 and max(abs(a - b) for a, b in zip(start, rested, strict=True)) < 1e-3
    assert driven[1] == pytest.approx(1.2, abs=0.03) and abs(driven[0]) < 0.01


def test_a_track_drawn_as_a_box_does_not_jam_it(tmp_path):
    shape = '<origin xyz="0.62 0 0"/><geometry><box size="1.6 0.3 0.36"/></geometry>'
    assert drive(write(tmp_path, *sprocket_with(shape)))[-1][1] == pytest.approx(1.2, abs=0.03)


def test_crawlers_without_joints_drive(tmp_path):
    text = GOOD
    for side in ("left", "right"):
        text = text.replace(
            f'<joint name="{side}_crawler" type="continuous">', f'<joint name="{side}_crawler" type="fixed">'
        )
        drives = '<crawler link="base" effort="1000" velocity="5"'
        text = text.replace(f'<crawler joint="{side}_crawler"', drives)
    robot = tmp_path / "robot.urdf"
    robot.write_text(text)
    assert drive(robot)[-1][1] == pytest.approx(1.2, abs=0.03)


def test_notices_are_told_once(tmp_path):
    robot = write(tmp_path, *bolt(parent="arm", type="prismatic"))
    short = ["--set", "learning.episodes=1", "--set", "episode.step_limit=5"]
    assert train(tmp_path / "run", "--robot", robot, *short).stderr.count("moves, but is no actuator") == 1


def test_a_run_folder_has_the_meshes_of_its_robot(tmp_path):
    package = tmp_path / "packages" / "bot"
    package.mkdir(parents=True)
    (package / "elbow.obj").write_text("v -0.05 -0.05 -0.05\nv 0.05 0.05 0.05\nv 0.05 0 0\nf 1 2 3\n")
    robot = write(tmp_path, ELBOW, '<mesh filename="package://bot/elbow.obj"/></geometry></collision>')
    short = ["--set", "learning.episodes=1", "--set", "episode.step_limit=5"]
    train(tmp_path / "run", "--robot", robot, "--packages", package.parent, *short)
    shutil.move(tmp_path / "run", tmp_path / "kept")
    shutil.rmtree(package)
    assert (tmp_path / "kept" / "robot_meshes" / "package_3a_2f_2fbot_2felbow.obj").is_file()
    run_script("evaluate", tmp_path / "kept", "--out", tmp_path / "evaluated", "--episodes", 1)
    assert (tmp_path / "evaluated" / "robot_meshes" / "package_3a_2f_2fbot_2felbow.obj").is_file()
    result = train(tmp_path / "again", "--robot", robot, *short, check=False)
    assert result.returncode == 2 and "package://bot/elbow.obj" in result.stderr
    assert not (tmp_path / "again").exists()


@pytest.mark.parametrize("program", ["controller", "simulator"])
def test_a_pipe_that_stays_silent_can_be_left(tmp_path, program):
    pipe = tmp_path / "robot.urdf"
    os.mkfifo(pipe)
    process = subprocess.Popen([paths.program(program), "--robot", pipe])
    with open(pipe, "wb"):  # once this is open, the program waits for what comes
        process.terminate()
        assert process.wait(timeout=10) == -signal.SIGTERM
