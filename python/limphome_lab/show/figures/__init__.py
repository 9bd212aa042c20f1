"""The figures of a run, one per file: the paper's Figs. 7, 8 and 9, how learning went, and a fixed path."""

from limphome_lab.messages import episode_states, last_session
from limphome_lab.show.figures import learning, motion, path, reward, style, trajectories

FIRST, LAST = 0, -1  # as episode_states understands them


def is_level(ground):
    """Whether the ground of these settings is a level plane; loose patches leave it one."""
    heights = ("incline_along_rad", "incline_across_rad", "rough_amplitude_m", "step_height_m")
    return all(float(ground[key]) == 0 for key in heights)


def draw_all(folder):
    """Draws every figure of a run into its figures/ folder; returns the files."""
    episodes = folder.read_episodes()
    recorded = episode_states(folder.messages, {FIRST, LAST})
    settings = folder.settings()
    figures = {
        "fig7_trajectories": trajectories.draw(recorded[FIRST], recorded[LAST]),
        "fig8_reward": reward.draw(episodes),
        "fig9_motion": motion.draw(folder.robot, *recorded[LAST], level=is_level(settings["ground"])),
        "fig_learning": learning.draw(episodes),
    }
    if settings["task"]["path"] != "rolling":
        figures["fig_path"] = path.draw(settings["task"]["path"], *last_session(folder.messages))
    folder.figures.mkdir(exist_ok=True)
    return [style.save(figure, folder.figures / f"{name}.png") for name, figure in figures.items()]
