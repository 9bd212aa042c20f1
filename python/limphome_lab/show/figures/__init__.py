"""The figures of a run, one per file: the paper's Figs. 7, 8 and 9, how learning went, and a fixed path. more.py has
those that are drawn on demand."""

from pathlib import Path

import matplotlib.pyplot as plt

from limphome_lab.messages import episode_states, last_session
from limphome_lab.show.figures import learning, motion, path, reward, style, trajectories
from limphome_lab.show.figures.paper import save_for_paper

FIRST, LAST = 0, -1  # as episode_states understands them


def is_level(ground):
    """Whether the ground of these settings is a level plane; loose patches leave it one."""
    heights = ("incline_along_rad", "incline_across_rad", "rough_amplitude_m", "step_height_m")
    return all(float(ground[key]) == 0 for key in heights)


def draw_all(folder):
    """Draws every figure that a training leaves into the run's figures/ folder; returns the files."""
    return save(figures(folder), folder.figures)


def figures(folder):
    """{name: figure} of them."""
    episodes = folder.read_episodes()
    recorded = episode_states(folder.messages, {FIRST, LAST})
    settings = folder.settings()
    drawn = {
        "fig7_trajectories": trajectories.draw(recorded[FIRST], recorded[LAST]),
        "fig8_reward": reward.draw(episodes),
        "fig9_motion": motion.draw(folder.robot, *recorded[LAST], level=is_level(settings["ground"])),
        "fig_learning": learning.draw(episodes),
    }
    if settings["task"]["path"] != "rolling":
        drawn["fig_path"] = path.draw(settings["task"]["path"], *last_session(folder.messages))
    return drawn


def save(drawn, out, paper=False):
    """Saves {name: figure} into a folder, for a screen, and for a paper in paper/ there; returns the files."""
    out = Path(out)
    out.mkdir(parents=True, exist_ok=True)
    files = []
    for name, figure in drawn.items():
        files.append(out / f"{name}.png")
        figure.savefig(files[-1], dpi=style.DPI)
        if paper:
            files += save_for_paper(figure, out / "paper", name)
        plt.close(figure)
    return files
