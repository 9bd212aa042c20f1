"""Panels that tell what the pair decides: of a live run as of a recorded one."""

from limphome_lab.view import told


class Told:
    """Puts its texts where the caller's `with` is."""

    def __init__(self, gui):
        self._episodes = gui.add_markdown("")
        self._action = gui.add_markdown("")
        self._figures = gui.add_markdown("")

    def decision(self, robot, decision, health):
        self._action.content = told.decision_table(robot, decision, health)
        self._figures.content = told.figures(decision)

    def episodes(self, now, ended):
        """`now`: (episode, decisions in it), or None; `ended`: rows of episodes.csv so far."""
        self._episodes.content = told.episodes(now, ended)

    def clear(self):
        self._episodes.content = self._action.content = self._figures.content = ""
