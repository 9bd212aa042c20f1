"""What the figures compute before they draw."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.text import Text

from limphome_lab.show.figures import is_level, paper, style
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


@pytest.mark.parametrize(("episodes", "window"), [(1, 5), (20, 5), (100, 11), (300, 31), (2500, 51)])
def test_the_running_window_follows_the_length_of_a_run(episodes, window):
    assert style.window(episodes) == window


# Machado, Oliveira and Fernandes (2009), severity 1.0: linear RGB as people without one kind of cone see it
BLINDNESS = {
    "protan": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deutan": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritan": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}
TO_XYZ = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
TELLABLE = 10  # CIE76 difference; 2.3 is just noticeable


def lab(colour, blindness):
    value = np.array([int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)])
    linear = np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)
    x, y, z = np.array(TO_XYZ) @ np.clip(np.array(BLINDNESS[blindness]) @ linear, 0, 1) / [0.9505, 1, 1.089]
    root = [each ** (1 / 3) if each > 0.008856 else 7.787 * each + 16 / 116 for each in (x, y, z)]
    return np.array([116 * root[1] - 16, 500 * (root[0] - root[1]), 200 * (root[1] - root[2])])


@pytest.mark.parametrize("blindness", BLINDNESS)
def test_colours_can_be_told_apart_by_the_colour_blind(blindness):
    seen = [lab(colour, blindness) for colour in style.SERIES]
    for i, one in enumerate(seen):
        assert all(np.linalg.norm(one - other) > TELLABLE for other in seen[:i])


def test_a_figure_for_a_paper_is_as_wide_as_a_column_or_a_page():
    for width, target in ((7.2, paper.COLUMN), (16, paper.PAGE)):
        figure, axes = plt.subplots(figsize=(width, 4), layout="constrained")
        axes.set_title("A title that belongs into the caption of a paper")
        axes.plot([0, 1], label="a line")
        figure.legend(loc="outside lower center", ncols=5)
        paper.fit(figure)
        figure.canvas.draw()
        assert figure.get_size_inches()[0] == pytest.approx(target)
        assert axes.get_title() == ""
        sizes = [text.get_fontsize() for text in figure.findobj(Text) if text.get_text()]
        assert min(sizes) >= paper.SMALL and max(sizes) <= paper.FONT
        plt.close(figure)
