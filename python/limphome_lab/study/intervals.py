"""Intervals of 95 % for what a few seeds have shown."""

import math

import numpy as np
from scipy import stats

CONFIDENCE = 0.95
RESAMPLES = 9999
NEVER = math.inf  # of a seed that has not learned


def share(successes, count):
    """Of a share, exact (Clopper and Pearson)."""
    interval = stats.binomtest(successes, count).proportion_ci(CONFIDENCE, method="exact")
    return interval.low, interval.high


def median(values):
    """Of the median, by the percentiles of a bootstrap over the seeds; None for a single one. The values may be NEVER,
    which is above every other."""
    if len(values) < 2:
        return None
    finite = [value for value in values if value < NEVER]
    above = 2 * max(finite, default=0) + 1  # stands for NEVER, which cannot be interpolated
    sample = np.minimum(values, above)
    if np.ptp(sample) == 0:
        return values[0], values[0]
    interval = stats.bootstrap(
        (sample,), np.median, confidence_level=CONFIDENCE, n_resamples=RESAMPLES, method="percentile", rng=0
    ).confidence_interval
    return tuple(NEVER if end > max(finite) else float(end) for end in interval)


def middle(values):
    """The median itself; NEVER where half of the seeds or more have not learned."""
    ordered = sorted(values)
    return (ordered[(len(ordered) - 1) // 2] + ordered[len(ordered) // 2]) / 2
