"""One episode by its decisions: how stable the robot stood, what its drives had to give, and how far it had come."""

import matplotlib.pyplot as plt
import numpy as np

from limphome_lab.show.figures import style


def draw(robot, episode, states, decisions):
    """`robot`: as limphome_lab.robot reads it; the rest: the messages of one episode."""
    begin = episode.utime * 1e-6 - episode.duration
    figure, (margin, torque, way) = plt.subplots(3, 1, figsize=(7.2, 7.4), sharex=True, layout="constrained")
    decided = [decision.utime * 1e-6 - begin for decision in decisions]
    _margin(margin, decided, [decision.stability_margin for decision in decisions])
    _torque(torque, robot, [state.utime * 1e-6 - begin for state in states], states)
    way.plot(decided, [decision.goal_distance for decision in decisions], color=style.BLUE, label="still to go")
    way.plot(
        decided,
        [decision.lateral_error for decision in decisions],
        color=style.RED,
        linestyle="--",
        label="to the left",
    )
    way.axhline(0, color=style.FAINT, linewidth=1)
    way.set(xlabel="time in the episode [s]", ylabel="from the line [m]")
    way.legend(loc="best")
    margin.set_title(f"Margin, torque and way in episode {episode.episode}")
    return figure


def _margin(axes, times, margins):
    margins = np.array(margins)
    axes.plot(times, margins, color=style.GREEN)
    axes.axhline(0, color=style.INK, linewidth=1)
    if (margins < 0).any():
        axes.fill_between(
            times, margins, 0, where=margins < 0, color=style.RED, alpha=0.3, linewidth=0, label="unstable"
        )
        axes.legend(loc="best")
    axes.set_ylabel("stability margin (11) [m]")


def _torque(axes, robot, times, states):
    """Of every drive as a share of its limit."""
    for index, actuator in enumerate(robot.told["actuators"]):
        colour, dash, _ = style.series(index)
        failed = states[0].actuator_health[index] == 1
        axes.plot(
            times,
            [100 * state.actuator_effort[index] / actuator["effort"] for state in states],
            color=colour,
            linestyle=":" if failed else dash,
            linewidth=1.2,
            label=actuator["name"].replace("_", " ") + (" (failed)" if failed else ""),
        )
    axes.axhline(0, color=style.FAINT, linewidth=1)
    axes.set_ylabel("torque [% of its limit]")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))
