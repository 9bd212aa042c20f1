"""What a stretch of episodes comes to: the figures of evaluations and of docs/results.md."""

import statistics


def summarise(episodes):
    """Shares and medians over a list of runfolder.Episode, which must not be empty."""
    count = len(episodes)
    outcomes = [episode.outcome for episode in episodes]

    def median(value):
        return statistics.median(map(value, episodes))

    return {
        "episodes": count,
        "goal_share": outcomes.count("goal") / count,
        "tumbles": outcomes.count("tumble"),
        "timeouts": outcomes.count("timeout"),
        "median_duration_s": median(lambda episode: episode.duration_s),
        "median_lateral_error_m": median(lambda episode: abs(episode.lateral_error_m)),
        "median_heading_change_rad": median(lambda episode: abs(episode.heading_change_rad)),
        "median_reward": median(lambda episode: episode.reward),
    }


LABELS = {
    "episodes": ("episodes", "{:d}"),
    "goal_share": ("reached the goal", "{:.1%}"),
    "tumbles": ("tumbled", "{:d}"),
    "timeouts": ("ran out of time", "{:d}"),
    "median_duration_s": ("median duration", "{:.1f} s"),
    "median_lateral_error_m": ("median |lateral error|", "{:.3f} m"),
    "median_heading_change_rad": ("median |change of heading|", "{:.3f} rad"),
    "median_reward": ("median total reward", "{:.2f}"),
    "missions": ("paths driven to their end, or tumbled", "{:d}"),
    "arrived": ("arrived", "{:d}"),
    "median_final_error_m": ("median final error", "{:.3f} m"),
    "worst_final_error_m": ("worst final error", "{:.3f} m"),
    "median_mission_s": ("median duration of a path", "{:.1f} s"),
}


def table(summary):
    """The summary as aligned lines of text."""
    rows = [(LABELS[name][0], LABELS[name][1].format(value)) for name, value in summary.items() if value is not None]
    width = max(len(label) for label, _ in rows)
    return "\n".join(f"{label:<{width}}  {value}" for label, value in rows)
