"""Unit quaternions, against closed forms and viser's rotations."""

import numpy as np
import pytest
from viser.transforms import SO3

from limphome_lab import quaternion
from limphome_lab.robot import rotation_about, rotation_of

AXIS = np.array([2.0, -3.0, 6.0]) / 7


@pytest.mark.parametrize("angle", [0.0, 0.3, np.pi, -2.5])
def test_turn_about_an_axis(angle):
    assert rotation_of(quaternion.about(AXIS, angle)) == pytest.approx(rotation_about(AXIS, angle))


def test_product_is_one_turn_after_the_other():
    a, b = quaternion.about(AXIS, 0.7), quaternion.about((0, 1, 0), -1.1)
    assert quaternion.product(a, b) == pytest.approx((SO3(a) @ SO3(b)).wxyz)
    assert rotation_of(quaternion.product(a, b)) == pytest.approx(rotation_of(a) @ rotation_of(b))


@pytest.mark.parametrize("share", [0.0, 0.25, 0.5, 1.0])
@pytest.mark.parametrize("angle", [1e-6, 0.01, 0.06, 0.07, 1.0, 3.0, -2.0])
def test_slerp_turns_at_a_constant_rate(share, angle):
    start = quaternion.about((0, 0, 1), 0.4)
    end = quaternion.product(quaternion.about(AXIS, angle), start)
    expected = quaternion.product(quaternion.about(AXIS, share * angle), start)
    assert quaternion.slerp(start, end, share) == pytest.approx(expected, abs=2e-6)
    assert quaternion.slerp(start, -end, share) == pytest.approx(expected, abs=2e-6)  # the same turn


def test_slerp_takes_the_shorter_way():
    start, end = quaternion.about((0, 0, 1), 0), quaternion.about((0, 0, 1), np.radians(350))
    assert quaternion.heading(quaternion.slerp(start, end, 0.5)) == pytest.approx(np.radians(-5))


def test_heading_of_a_body_that_leans():
    leaning = quaternion.product(quaternion.about((0, 0, 1), 2.0), quaternion.about((1, 0, 0), 0.5))
    assert quaternion.heading(leaning) == pytest.approx(2.0)
