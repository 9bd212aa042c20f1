"""When a run had learned, whether it held, and what it came to. Pure functions of the rows of episodes.csv.

The criterion is that of 20 episodes in a row, of 2 m each: at least 19 goals, no tumble, and at the median at most
0.10 m beside the line, 5 degrees of turn and 9 s. A run *learned at n* if the window after episode n is the first that
fulfils it; n = 0 is possible.
"""

import math
import statistics

WINDOW = 20  # episodes
GOALS = 19  # of a window, at least
LATERAL_ERROR_M = 0.10
HEADING_CHANGE_RAD = math.radians(5)
DURATION_S = 9.0
PACE_MARGIN = 1.3  # over a run's own best pace, on hard ground
LAST = 60  # episodes that tell how well a run drives at its end


def windows(episodes):
    """Every stretch of 20 episodes in a row; the first after episode 0, the next after episode 1, and so on."""
    return [episodes[first : first + WINDOW] for first in range(len(episodes) - WINDOW + 1)]


def median_size(episodes, quantity):
    """Median of the magnitude of a column."""
    return statistics.median(abs(getattr(episode, quantity)) for episode in episodes)


def _straight_home(window):
    """All of the criterion but the duration."""
    outcomes = [episode.outcome for episode in window]
    return (
        outcomes.count("goal") >= GOALS
        and "tumble" not in outcomes
        and median_size(window, "lateral_error_m") <= LATERAL_ERROR_M
        and median_size(window, "heading_change_rad") <= HEADING_CHANGE_RAD
    )


def duration_limit(episodes, hard=False):
    """Median duration allowed to a window [s]. On hard ground it follows the run's own best pace: the shortest median
    duration of the windows that go straight home."""
    if not hard:
        return DURATION_S
    paces = [median_size(window, "duration_s") for window in windows(episodes) if _straight_home(window)]
    return max(DURATION_S, PACE_MARGIN * min(paces, default=0))


def _fulfilled(episodes, hard):
    """Of each window, whether it fulfils the criterion."""
    limit = duration_limit(episodes, hard)
    return [_straight_home(window) and median_size(window, "duration_s") <= limit for window in windows(episodes)]


def learned_at(episodes, hard=False):
    """The least n after which a window fulfils the criterion; None: never."""
    fulfilled = _fulfilled(episodes, hard)
    return fulfilled.index(True) if True in fulfilled else None


def held(episodes, hard=False):
    """Share of the windows after n, to the run's end, that fulfil the criterion; None where nothing was learned."""
    n = learned_at(episodes, hard)
    return None if n is None else statistics.mean(_fulfilled(episodes, hard)[n:])


def robot_minutes(episodes, hard=False):
    """Time of the robot until it had learned: episodes 1 to n [minutes]; None where nothing was learned."""
    n = learned_at(episodes, hard)
    return None if n is None else sum(episode.duration_s for episode in episodes[:n]) / 60


def last(episodes):
    """(median duration [s], median lateral error [m]) of the last 60 episodes."""
    end = episodes[-LAST:]
    return median_size(end, "duration_s"), median_size(end, "lateral_error_m")
