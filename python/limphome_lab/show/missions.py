"""What driving along a path to its end comes to: a mission is what happens from one reset to the next."""

import statistics

from limphome import episode_t
from limphome_lab.channels import EPISODE
from limphome_lab.messages import recorded


def missions(log):
    """[[episode_t]] of the missions in a recording that ended by arriving or tumbling.

    The last may have been going on when the run ended, and one whose episode's number is a multiple of
    [episode] reset_every is broken off.
    """
    of_session = {}
    for _, episode in recorded(log, EPISODE):
        of_session.setdefault(episode.session, []).append(episode)
    return [episodes for episodes in of_session.values() if _has_ended(episodes[-1])]


def _has_ended(episode):
    return episode.arrived or episode.outcome == episode_t.TUMBLE


def summarise(ended):
    """Over a list as `missions` gives it. Final errors and durations are of those that arrived; None without any."""
    arrived = [episodes for episodes in ended if episodes[-1].arrived]
    errors = [episodes[-1].waypoint_distance for episodes in arrived]
    durations = [sum(episode.duration for episode in episodes) for episodes in arrived]
    return {
        "missions": len(ended),
        "arrived": len(arrived),
        "median_final_error_m": statistics.median(errors) if arrived else None,
        "worst_final_error_m": max(errors, default=None),
        "median_mission_s": statistics.median(durations) if arrived else None,
    }
