"""What a stretch of episodes comes to: the figures of evaluations and of docs/results.md."""

import statistics


def quartiles(values):
    """(lower, median, upper), interpolated between neighbours; of a single value it is all three."""
    values = sorted(values)
    return tuple(statistics.quantiles(values, n=4, method="inclusive")) if len(values) > 1 else tuple(values) * 3


def summarise(episodes):
    """Shares, medians and their spread over a list of runfolder.Episode, which must not be empty."""
    count = len(episodes)
    outcomes = [episode.outcome for episode in episodes]

    def median(value):
        return statistics.median(map(value, episodes))

    def spread(value):
        values = list(map(value, episodes))
        lower, _, upper = quartiles(values)
        return [lower, upper, max(values)]

    return {
        "episodes": count,
        "goal_share": outcomes.count("goal") / count,
        "tumbles": outcomes.count("tumble"),
        "timeouts": outcomes.count("timeout"),
        "median_duration_s": median(lambda episode: episode.duration_s),
        "median_lateral_error_m": median(lambda episode: abs(episode.lateral_error_m)),
        "median_heading_change_rad": median(lambda episode: abs(episode.heading_change_rad)),
        "median_reward": median(lambda episode: episode.reward),
        "spread_duration_s": spread(lambda episode: episode.duration_s),
        "spread_lateral_error_m": spread(lambda episode: abs(episode.lateral_error_m)),
        "spread_heading_change_rad": spread(lambda episode: abs(episode.heading_change_rad)),
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
    rows = [
        (label, form.format(summary[name]) + _beside(summary, name, form))
        for name, (label, form) in LABELS.items()
        if summary.get(name) is not None
    ]
    width = max(len(label) for label, _ in rows)
    return "\n".join(f"{label:<{width}}  {value}" for label, value in rows)


def _beside(summary, name, form):
    """How far the episodes are spread about a median."""
    spread = summary.get(name.replace("median", "spread", 1)) if name.startswith("median") else None
    if spread is None or summary["episodes"] < 2:
        return ""
    number = form.partition(" ")[0]
    lower, upper, worst = (number.format(value) for value in spread)
    return f"  (quartiles {lower} to {upper}, most {worst})"
