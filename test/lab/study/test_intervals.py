"""Intervals, against closed forms."""

import pytest

pytest.importorskip("scipy")

from limphome_lab.study import intervals
from limphome_lab.study.intervals import NEVER


def test_share_of_none_and_of_all_is_the_root_of_the_error():
    # Clopper and Pearson: (alpha/2)^(1/n) where all succeed
    low, high = intervals.share(20, 20)
    assert high == 1
    assert low == pytest.approx(0.025 ** (1 / 20))
    assert intervals.share(0, 20) == pytest.approx((0, 1 - 0.025 ** (1 / 20)))


def test_median_of_equals_is_sure_of_it():
    assert intervals.median([7, 7, 7]) == (7, 7)
    assert intervals.median([NEVER, NEVER]) == (NEVER, NEVER)


def test_median_of_one_has_no_interval():
    assert intervals.median([7]) is None


def test_median_lies_within_and_the_same_seeds_give_the_same():
    values = [10, 12, 13, 15, 17, 20, 31, 40]
    low, high = intervals.median(values)
    assert 10 <= low < intervals.middle(values) < high <= 40
    assert intervals.median(values) == (low, high)


def test_never_is_above_all_others():
    values = [10, 12, 13, 15, 17, NEVER, NEVER]
    low, high = intervals.median(values)
    assert low < 17
    assert high == NEVER
    assert intervals.middle(values) == 15
    assert intervals.middle([10, NEVER]) == NEVER
