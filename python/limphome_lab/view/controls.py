"""Panels by which a person chooses how time goes, what is shown and from where."""

import time

import numpy as np

from limphome import pace_t, pose_t
from limphome_lab.channels import PACE
from limphome_lab.view.scene import LAYERS

PACES = {"1/4": 0.25, "1": 1.0, "4": 4.0, "20": 20.0, "free": pose_t.PACE_FREE}
KEEP_EVERY_S = 1.0
SIDES = {  # where the eye is, from the robot [m]; it stands facing +y
    "from behind": (2.8, -3.7, 2.5),
    "from the side": (5.0, 0.4, 1.5),
    "from ahead": (-2.8, 4.2, 2.2),
    "from above": (0.0, -0.5, 7.0),
}
LOOKED_AT = (0.0, 0.3, 0.45)
FIELD_OF_VIEW = np.radians(45)


class Pace:
    """How fast the plant's time goes. `say(channel, message)` sends."""

    def __init__(self, gui, say, later):
        self.say = say
        self._kept = 0.0
        self.wanted = None  # held to it; None: as it comes
        self.text = gui.add_markdown("pace: -")
        acts = {
            "Pause": lambda: self.send(pace_t.PAUSE),
            "Go on": self._go_on,
            "Step": lambda: self.send(pace_t.STEP),
            "Reset": lambda: self.send(pace_t.RESET),
        }
        self._acts = gui.add_button_group("time (P, N, R)", tuple(acts))
        self._acts.on_click(lambda _: later(acts[self._acts.value]))
        for words, key, act in (
            ("Pause or go on", "P", lambda: (acts["Go on"] if self._paused else acts["Pause"])()),
            ("One decision", "N", acts["Step"]),
            ("Reset the robot", "R", acts["Reset"]),
        ):
            gui.add_command(words, hotkey=key).on_trigger(lambda _, act=act: later(act))
        self._choice = gui.add_button_group("pace", tuple(PACES))
        self._choice.on_click(lambda _: later(lambda: self.run(PACES[self._choice.value])))
        self._paused = False

    def run(self, pace):
        self.wanted = pace
        self.send(pace_t.RUN, pace)

    def _go_on(self):
        self.run(1.0 if self.wanted is None else self.wanted)

    def show(self, pace, lockstep):
        """What the plant says. One in real time goes by the clock and cannot be held."""
        self._paused = pace == 0
        self._acts.visible = self._choice.visible = lockstep

    def keep(self):
        """Call often while somebody looks: a plant that is held goes on by itself once its viewer is gone."""
        if time.monotonic() - self._kept >= KEEP_EVERY_S:
            self._kept = time.monotonic()
            self.send(pace_t.KEEP)

    def send(self, action, pace=0.0):
        message = pace_t()
        message.utime = time.monotonic_ns() // 1000
        message.action, message.pace = action, pace
        self.say(PACE, message)


class Eye:
    """Camera and layers."""

    def __init__(self, page):
        self.page = page
        page.initial_camera.position, page.initial_camera.look_at = SIDES["from behind"], LOOKED_AT
        page.initial_camera.fov = FIELD_OF_VIEW
        gui = page.gui
        self.follow = gui.add_checkbox("follow the robot", True)
        self._sides = gui.add_button_group("look", tuple(SIDES))
        self._sides.on_click(lambda event: self._look(event.client, SIDES[self._sides.value]))
        with gui.add_folder("shown", expand_by_default=False):
            self.glass = gui.add_checkbox("see through the robot", False)
            self._layers = {layer: gui.add_checkbox(layer, True) for layer in LAYERS}

    def apply(self, scene):
        """Call with each frame: what was chosen, to a RobotScene."""
        scene.follow = self.follow.value
        scene.set_glass(self.glass.value)
        for layer, box in self._layers.items():
            if scene.shown[layer] != box.value:
                scene.set_shown(layer, box.value)

    def _look(self, client, side):
        at = np.zeros(3) if self.follow.value else self._robot_at()
        client.camera.position, client.camera.look_at = at + side, at + LOOKED_AT

    def _robot_at(self):
        return self.position * (1, 1, 0)

    position = np.zeros(3)  # of the robot, for who does not follow it
