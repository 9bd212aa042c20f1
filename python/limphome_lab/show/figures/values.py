"""Value over two inputs of what was learned, all others as they were at the median of an episode."""

import matplotlib.pyplot as plt
import numpy as np

from limphome_lab.show.policy import TILTS

CELLS = 81  # along each side
TILT_SHOWN = 0.5  # [rad]; beyond it a robot hardly ever is


def draw(policy, chosen, visited, crawlers, episode):
    """`policy`: of show/policy.py; `chosen`: indices of two of its inputs; `visited` [n x inputs]: where an episode has
    been; `crawlers`: names of actuators whose input is a torque."""
    sides = [_side(policy, index) for index in chosen]
    across, up = np.meshgrid(*sides)
    states = np.tile(np.median(visited, axis=0), (across.size, 1))
    states[:, chosen[0]], states[:, chosen[1]] = across.ravel(), up.ravel()
    figure, axes = plt.subplots(figsize=(6.4, 5.0), layout="constrained")
    map_ = axes.pcolormesh(across, up, policy.values(states).reshape(across.shape), cmap="cividis", shading="gouraud")
    axes.plot(*visited[:, chosen].T, color="white", linewidth=1, marker=".", markersize=3, label=f"episode {episode}")
    axes.set(xlim=sides[0][[0, -1]], ylim=sides[1][[0, -1]])
    for index, tell in zip(chosen, (axes.set_xlabel, axes.set_ylabel), strict=True):
        name = policy.names[index]
        tell(f"torque of {name.replace('_', ' ')} [N m]" if name in crawlers else f"{name} [rad]")
    figure.colorbar(map_, label=policy.label)
    axes.grid(visible=False)
    axes.set_title(_title(policy, chosen, states[0]))
    axes.legend(loc="lower left", labelcolor="white")
    return figure


def _side(policy, index):
    low, high = policy.low[index], policy.high[index]
    if policy.names[index] in TILTS:
        low, high = -TILT_SHOWN, TILT_SHOWN
    return np.linspace(low, high, CELLS)


def _title(policy, chosen, state):
    """Where the rest is held."""
    rest = [f"{name} {state[k]:.2g}" for k, name in enumerate(policy.names) if k not in chosen]
    return "\n".join(["Value, the rest at the median of the episode:", ", ".join(rest)]) if rest else "Value"
