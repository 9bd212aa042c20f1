"""When a run had learned, on rows made by hand."""

import math

import pytest

from limphome_lab.runfolder import Episode
from limphome_lab.show import learned


def row(outcome="goal", duration_s=7.0, lateral_error_m=0.02, heading_change_rad=0.01):
    return Episode(1, outcome, 14, duration_s, 0, 0, 0, 0, 0, lateral_error_m, heading_change_rad, 1)


GOOD, SLOW, LOST, FALL = row(), row(duration_s=11.0), row("timeout", 100.0), row("tumble", 2.0)


def test_good_from_the_start():
    assert learned.learned_at([GOOD] * 20) == 0
    assert learned.held([GOOD] * 20) == 1
    assert learned.robot_minutes([GOOD] * 20) == 0


def test_too_short_to_tell():
    assert learned.learned_at([GOOD] * 19) is None
    assert learned.held([GOOD] * 19) is None
    assert learned.robot_minutes([GOOD] * 19) is None


def test_least_n_and_the_time_it_took():
    episodes = [LOST] * 7 + [GOOD] * 30
    assert learned.learned_at(episodes) == 6  # one of 20 may miss the goal
    assert learned.robot_minutes(episodes) == pytest.approx(10)


def test_one_missed_goal_is_allowed_and_no_second():
    assert learned.learned_at([LOST] + [GOOD] * 19) == 0
    assert learned.learned_at([LOST] * 2 + [GOOD] * 18) is None


def test_no_tumble_is_allowed():
    assert learned.learned_at([FALL] + [GOOD] * 19) is None
    assert learned.learned_at([FALL] + [GOOD] * 20) == 1


@pytest.mark.parametrize(
    ("column", "most"),
    [
        ("duration_s", 9.0),
        ("lateral_error_m", 0.10),
        ("lateral_error_m", -0.10),
        ("heading_change_rad", math.radians(5)),
        ("heading_change_rad", -math.radians(5)),
    ],
)
def test_medians_up_to_the_limit(column, most):
    assert learned.learned_at([row(**{column: most})] * 20) == 0
    beyond = row(**{column: 1.001 * most})
    assert learned.learned_at([beyond] * 20) is None
    assert learned.learned_at([beyond] * 9 + [GOOD] * 11) == 0  # the median counts, not the worst


def test_held_is_the_share_of_the_windows_from_n_on():
    episodes = [GOOD] * 20 + [SLOW] * 20
    # windows that begin after 0 to 20; the median of the one after 10 is the mean of 7 and 11 s, 9 s still
    assert learned.learned_at(episodes) == 0
    assert learned.held(episodes) == pytest.approx(11 / 21)


def test_windows_before_n_do_not_count_as_lost():
    assert learned.held([SLOW] * 30 + [GOOD] * 30) == 1


def test_hard_ground_follows_the_best_pace():
    episodes = [row(duration_s=20.0)] * 20 + [row(duration_s=15.0)] * 20
    assert learned.learned_at(episodes) is None
    assert learned.duration_limit(episodes, hard=True) == pytest.approx(19.5)
    assert learned.learned_at(episodes, hard=True) == 10  # the median of the window is then 17.5 s


def test_hard_ground_allows_9_s_at_least():
    assert learned.duration_limit([row(duration_s=6.5)] * 40, hard=True) == 9


def test_best_pace_is_that_of_windows_that_get_home():
    assert learned.duration_limit([FALL] * 20 + [row(duration_s=15.0)] * 20, hard=True) == pytest.approx(19.5)
    assert learned.duration_limit([FALL] * 20, hard=True) == 9


def test_last_60():
    assert learned.last([SLOW] * 40 + [row(duration_s=7.0, lateral_error_m=-0.05)] * 60) == (7.0, 0.05)
