"""Forward kinematics of the pictures, against the geometry of config/crawler.urdf worked out by hand."""

from math import cos, pi, sin

import numpy as np
import pytest

from limphome_lab import paths
from limphome_lab.ending import InputError
from limphome_lab.robot import apply, read, rotation_about, rotation_of

UPRIGHT = [1, 0, 0, 0]


@pytest.fixture(scope="module")
def robot():
    return read(paths.CONFIG / "crawler.urdf")


def tip(robot, position, orientation, swing, boom, arm):
    (ball,) = robot.tips
    return apply(robot.frames([0, 0, swing, boom, arm], position, orientation)[ball["body"]], ball["point"])


def test_actuators_are_crawlers_then_arm(robot):
    assert robot.actuators == ["left_crawler", "right_crawler", "swing", "boom", "arm"]
    assert robot.crawlers + robot.arm == robot.actuators
    assert robot.home == pytest.approx([0, 0, 0, 0.6, -1.5])


@pytest.mark.parametrize("swing, boom, arm", [(0, 0, 0), (0, 0.6, -1.5), (1.2, -0.3, -2.0), (-2.6, 1.2, -2.4)])
def test_tip_of_the_arm(robot, swing, boom, arm):
    # swing axis at the origin; boom pivot 0.4 m ahead, 0.8 m up; boom 1.1 m, arm 0.8 m; positive angles raise
    reach = 0.4 + 1.1 * cos(boom) + 0.8 * cos(boom + arm)
    height = 0.8 + 1.1 * sin(boom) + 0.8 * sin(boom + arm)
    expected = [reach * cos(swing), reach * sin(swing), height]
    assert tip(robot, [0, 0, 0], UPRIGHT, swing, boom, arm) == pytest.approx(expected)


def test_body_is_turned_then_moved(robot):
    quarter_left = [cos(pi / 4), 0, 0, sin(pi / 4)]
    x, y, z = tip(robot, [0, 0, 0], UPRIGHT, 0.5, 0.2, -1.0)
    assert tip(robot, [3, 4, 5], quarter_left, 0.5, 0.2, -1.0) == pytest.approx([3 - y, 4 + x, 5 + z])


def test_turning_sprockets_moves_nothing(robot):
    still = robot.posed([0, 0, 0], UPRIGHT, [0, 0, 0.1, 0.2, -0.3])
    rolling = robot.posed([0, 0, 0], UPRIGHT, [7.0, -3.0, 0.1, 0.2, -0.3])
    assert all(np.array_equal(a.points, b.points) for a, b in zip(still, rolling, strict=True))


def test_crawlers_stand_on_the_ground_and_fill_the_size_of_the_robot(robot):
    parts = {part.name: part.points for part in robot.posed([0, 0, 0], UPRIGHT, [0] * 5)}
    both = np.vstack([parts["left_crawler"], parts["right_crawler"]])
    assert np.ptp(both, axis=0) == pytest.approx([1.6, 1.25, 0.36])
    assert both[:, 2].min() == pytest.approx(0, abs=1e-9)
    assert parts["upper_body"][:, 2].max() == pytest.approx(1.36)  # height of the robot without the arm


def test_every_kind_of_shape_has_its_size(tmp_path):
    text = (paths.CONFIG / "crawler.urdf").read_text()
    cylinder = '<collision><origin xyz="0 0 2"/><geometry><cylinder radius="0.1" length="0.6"/></geometry></collision>'
    ball = '<collision><origin xyz="0 0 3"/><geometry><sphere radius="0.2"/></geometry></collision>'
    file = tmp_path / "shapes.urdf"
    file.write_text(text.replace('<link name="upper_body">', f'<link name="upper_body">{cylinder}{ball}'))
    sizes = [np.ptp(part.points, axis=0) for part in read(file).parts if part.name == "upper_body"]
    for expected in ([0.2, 0.2, 0.6], [0.4, 0.4, 0.4], [1.0, 0.8, 0.86]):
        assert any(size == pytest.approx(expected, abs=1e-9) for size in sizes), (expected, sizes)


def test_a_file_that_is_refused_ends_with_its_reasons(tmp_path):
    file = tmp_path / "none.urdf"
    file.write_text('<robot name="none"><link name="base"/></robot>')
    with pytest.raises(InputError, match=r"none\.urdf"):
        read(file)


@pytest.mark.parametrize("axis", np.eye(3))
def test_rotations_are_rotations(axis):
    turn = rotation_about(axis, 0.7)
    assert turn @ turn.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(turn) == pytest.approx(1)
    assert np.trace(turn) == pytest.approx(1 + 2 * cos(0.7))
    assert turn @ axis == pytest.approx(axis)


def test_quaternion_of_any_length_counts_as_its_direction():
    assert rotation_of([2, 0, 0, 2]) == pytest.approx(rotation_about([0, 0, 1], pi / 2))
