"""Figures of scripts/growth."""

import matplotlib.pyplot as plt
import numpy as np

from limphome_lab.show.figures import style

SIZE = (9, 3.4)  # of two panels side by side [inch]


def draw(measured, folder):
    """Writes the figures of growth.json; returns their files."""
    figures = {
        "growth_step": _step(measured),
        "growth_decision": _decision(measured["decision"]),
        "growth_run": _run(measured),
        "growth_study": _study(measured["study"]),
    }
    return [style.save(figure, folder / f"{name}.png") for name, figure in figures.items()]


def _panels(count, width=SIZE[0]):
    return plt.subplots(1, count, figsize=(width, SIZE[1]), layout="constrained")


def _from_zero(values):
    return 0, 1.1 * max(values)


def _usual(points):
    """Without the few in which the machine did something else [µs]."""
    seconds = np.array([each[1] for ground in points.values() for each in ground])
    return 1e6 * seconds[seconds <= np.quantile(seconds, 0.98)]


def _step(measured):
    figure, (joints, contacts, grounds) = _panels(3, 11)
    x, seconds = np.array(measured["step_over_joints"]).T
    joints.plot(x, 1e6 * seconds, color=style.BLUE, marker="o")
    joints.set(
        xlabel="joints of the arm, swing included", ylabel="a step [µs]", ylim=_from_zero(1e6 * seconds), xticks=x
    )
    for number, (ground, points) in enumerate(measured["step_over_contacts"].items()):
        touching, seconds = np.array(points).T
        colour = style.series(number)[0]
        contacts.scatter(touching, 1e6 * seconds, color=colour, s=12, alpha=0.5, linewidths=0, label=ground)
    contacts.set(xlabel="points of contact", ylim=_from_zero(_usual(measured["step_over_contacts"])))
    contacts.legend()
    kinds = measured["step_over_grounds"]
    grounds.bar(list(kinds), [1e6 * value for value in kinds.values()], color=style.BLUE, width=0.6)
    grounds.set(xlabel="ground")
    grounds.grid(axis="x", visible=False)
    figure.suptitle("Processor time of a simulated step of 5 ms")
    return figure


def _decision(curves):
    figure, (units, actions, planner) = _panels(3, 11)
    for axes, curve, label in ((units, "units", "units of the network"), (actions, "actions", "joint actions")):
        x, seconds = np.array(curves[curve]).T
        axes.plot(x, 1e6 * seconds, color=style.BLUE, marker="o")
        axes.set(xlabel=label)
    units.set(ylabel="a decision [µs]", title="Q-learning, 81 actions", ylim=(0, None))
    actions.set(title="Q-learning, 50 units", xscale="log", yscale="log")
    for number, (curve, label) in enumerate((("samples", "measurements kept"), ("postures", "postures planned for"))):
        x, seconds = np.array(curves[curve]).T
        colour, _, marker = style.series(number)
        planner.plot(x, 1e6 * seconds, color=colour, marker=marker, label=label)
    planner.set(title="Planner", xlabel="of either", ylim=(0, None), ylabel="a decision [µs]")
    planner.legend()
    figure.suptitle("Processor time of a decision")
    return figure


def _run(measured):
    figure, (memory, disk, wall) = _panels(3, 11)
    for number, (name, title) in enumerate((("run_paper", "paper.ini"), ("run_planner", "default.ini, a planner"))):
        episodes, in_memory, on_disk, seconds = np.array(measured[name]).T
        look = {"color": style.series(number)[0], "label": title}
        memory.plot(episodes, in_memory, **look)
        disk.plot(episodes, on_disk, **look)
        wall.plot(episodes, seconds, **look)
    memory.set(ylabel="memory of the programs [MB]")
    disk.set(ylabel="run folder [MB]")
    wall.set(ylabel="wall time [s]")
    for axes in (memory, disk, wall):
        axes.set(xlabel="episodes", xlim=(0, None), ylim=(0, None))
    memory.legend()
    figure.suptitle("A run over its episodes")
    return figure


def _study(curves):
    figure, (seconds, speed) = _panels(2)
    alone = dict(curves["1"])
    for number, (cores, points) in enumerate(curves.items()):
        runs, taken = np.array(points).T
        colour, _, marker = style.series(number)
        look = {"color": colour, "marker": marker, "label": f"{cores} core{'s' if cores != '1' else ''}"}
        seconds.plot(runs, taken, **look)
        speed.plot(runs, [alone[n] / t for n, t in zip(runs, taken, strict=True)], **look)
    seconds.set(xlabel="runs", ylabel="wall time [s]", ylim=(0, None), xlim=(0, None))
    speed.set(xlabel="runs", ylabel="times as fast as on one core", ylim=(0, None), xlim=(0, None))
    seconds.legend()
    figure.suptitle("A study over its runs, report included")
    return figure
