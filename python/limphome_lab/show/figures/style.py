"""How all figures look."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np

DPI = 150
INK = "#222222"
FAINT = "#9aa5b1"  # single episodes, references
# of Okabe and Ito, whom people with any kind of colour blindness can follow
BLUE = "#0072b2"  # the learned, the running median
ORANGE = "#e69f00"  # the beginning, the arm
RED = "#d55e00"  # the failed crawler, tumbles
GREEN = "#009e73"  # the goal
PURPLE = "#cc79a7"
SKY = "#56b4e9"
SERIES = (BLUE, RED, GREEN, PURPLE, ORANGE, SKY, INK)  # of experiments side by side
DASHES = ("-", "--", "-.", ":")  # for a second round of colours
MARKERS = ("o", "s", "^", "D", "v", "P", "X")

MEDIAN_WINDOW = 51  # episodes, of a run that is long enough

plt.rcParams.update(
    {
        "font.size": 10,
        "axes.titlesize": 11,
        "axes.labelsize": 10,
        "legend.fontsize": 9,
        "axes.edgecolor": INK,
        "axes.labelcolor": INK,
        "xtick.color": INK,
        "ytick.color": INK,
        "text.color": INK,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "grid.color": "#e3e7eb",
        "grid.linewidth": 0.8,
        "axes.axisbelow": True,
        "legend.frameon": False,
    }
)


def series(number):
    """(colour, dash, marker) of an experiment."""
    return (
        SERIES[number % len(SERIES)],
        DASHES[number // len(SERIES) % len(DASHES)],
        MARKERS[number % len(MARKERS)],
    )


def save(figure, path):
    figure.savefig(path, dpi=DPI)
    plt.close(figure)
    return path


def window(count):
    """Episodes of a running median over so many: a tenth of them, odd, from 5 to 51."""
    return min(MEDIAN_WINDOW, max(5, count // 10 | 1))


def running(values, statistic=np.median, window=MEDIAN_WINDOW):
    """`statistic` over up to `window` values centred on each; the window is cut off at the ends."""
    values = np.asarray(values, dtype=float)
    half = window // 2
    return np.array([statistic(values[max(0, i - half) : i + half + 1]) for i in range(len(values))])


def episode_frame(points, start, heading):
    """World points [n x 2 or 3] as seen from the start of an episode: start at (0, 0), facing +y."""
    points = np.array(points, dtype=float)
    turn = np.pi / 2 - heading
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    points[:, :2] = (points[:, :2] - np.asarray(start)) @ rotation.T
    return points
