"""Where the eye of a video is, by projecting what it is to see."""

import numpy as np
import pytest
from viser.transforms import SO3

from limphome_lab.view import angles

POINTS = np.random.default_rng(5).uniform((-1, -0.5, 0), (1, 2.5, 1.3), (200, 3))


def projected(eye, points, width_to_height):
    """[n x 2] in the picture: -1 to 1 from edge to edge."""
    x, y, ahead = ((points - eye.position) @ SO3(eye.wxyz).as_matrix()).T
    assert (ahead > 0).all()
    up = np.tan(angles.FIELD_OF_VIEW / 2)
    return np.column_stack([x / (up * width_to_height), y / up]) / ahead[:, None]


@pytest.mark.parametrize("width_to_height", [0.5, 1.0, 2.5])
@pytest.mark.parametrize("name", angles.ANGLES)
def test_all_is_in_the_picture_and_fills_it(name, width_to_height):
    seen = projected(angles.fitted(angles.towards(name, False), POINTS, width_to_height), POINTS, width_to_height)
    limit = 1 - 2 * angles.MARGIN
    filled = np.abs(seen).max(axis=0)
    assert (filled <= limit + 1e-9).all()
    assert filled.max() == pytest.approx(limit)  # nearer, and something would be outside


@pytest.mark.parametrize("name", angles.ANGLES)
def test_up_is_up(name):
    eye = angles.fitted(angles.towards(name, False), POINTS, 1.5)
    high = np.array([[0, 1, 0.0], [0, 1, 1.0]]) if name != "above" else np.array([[0, 0, 0.0], [0, 1.0, 0.0]])
    low_seen, high_seen = projected(eye, high, 1.5)
    assert high_seen[1] < low_seen[1]  # y of a picture points down


def test_the_side_is_that_of_what_failed():
    assert angles.towards("side", False)[0] < 0 < angles.towards("side", True)[0]
