"""What the figures compute before they draw."""

import numpy as np
import pytest

from limphome_lab.show.figures import is_level
from limphome_lab.show.figures.outline import convex_hull
from limphome_lab.show.figures.style import episode_frame, running


def test_episode_frame_puts_the_start_at_the_origin_facing_up():
    start, heading = np.array([3.0, -2.0]), 0.4
    ahead = start + 2.0 * np.array([np.cos(heading), np.sin(heading)])
    right = start + 0.5 * np.array([np.sin(heading), -np.cos(heading)])
    seen = episode_frame([start, ahead, right], start, heading)
    assert seen == pytest.approx(np.array([[0, 0], [0, 2], [0.5, 0]]), abs=1e-12)


def test_episode_frame_leaves_heights_alone():
    assert episode_frame([[1.0, 2.0, 0.7]], [1.0, 2.0], 1.0) == pytest.approx(np.array([[0, 0, 0.7]]))


def test_running_median_is_cut_off_at_the_ends():
    assert running([5, 1, 9, 2, 7], window=3) == pytest.approx([3, 5, 2, 7, 4.5])


def test_running_statistic_of_fewer_values_than_the_window():
    assert running([1, 2, 6], np.mean, window=51) == pytest.approx([3, 3, 3])


def test_convex_hull_of_a_square_with_points_inside():
    random = np.random.default_rng(1)
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    hull = convex_hull(np.vstack([random.uniform(0.01, 0.99, (50, 2)), corners, corners]))
    assert hull == pytest.approx(corners)


def test_convex_hull_holds_every_point_on_its_left():
    points = np.random.default_rng(2).normal(size=(200, 2))
    hull = convex_hull(points)
    for a, b in zip(hull, np.roll(hull, -1, axis=0), strict=True):
        edge, to_points = b - a, points - a
        assert (edge[0] * to_points[:, 1] - edge[1] * to_points[:, 0] >= -1e-12).all()


LEVEL = {"incline_along_rad": "0", "incline_across_rad": "0", "rough_amplitude_m": "0", "step_height_m": "0"}


def test_level_ground_is_told_from_any_other():
    assert is_level(LEVEL | {"patch_share": "0.3"})
    assert not any(is_level(LEVEL | {key: "0.1"}) for key in LEVEL)
