"""Panels by which a person chooses how time goes, what is shown and from where."""

import time

import numpy as np

from limphome import pace_t, pose_t
from limphome_lab.channels import PACE
from limphome_lab.view.scene import LAYERS

PACES = {"1/4": 0.25, "1": 1.0, "4": 4.0, "20": 20.0, "free": pose_t.PACE_FREE}
KEEP_EVERY_S = 1.0
SIDES = {  # where the eye is, from the robot [m]; it stands facing +y
    "from behind": (2.4, -3.2, 2.2),
    "from the side": (4.2, 0.2, 1.3),
    "from ahead": (-2.4, 3.6, 1.8),
    "from above": (0.0, -0.5, 6.0),
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
        self._buttons = [
            self._button(gui, "Pause", "P", lambda: self.pause_or_go(), later),
            self._button(gui, "One decision", "N", lambda: self.send(pace_t.STEP), later),
            self._button(gui, "Reset the robot", "R", lambda: self.send(pace_t.RESET), later),
        ]
        self._choice = gui.add_button_group("pace", tuple(PACES))
        self._choice.on_click(lambda _: later(lambda: self.run(PACES[self._choice.value])))
        self._paused = False

    def _button(self, gui, label, key, action, later):
        button = gui.add_button(f"{label}  ({key})")
        button.on_click(lambda _: later(action))
        gui.add_command(label, hotkey=key).on_trigger(lambda _: later(action))
        return button

    def run(self, pace):
        self.wanted = pace
        self.send(pace_t.RUN, pace)

    def pause_or_go(self):
        if self._paused:
            self.run(1.0 if self.wanted is None else self.wanted)
        else:
            self.send(pace_t.PAUSE)

    def show(self, pace, lockstep):
        """What the plant says. One in real time goes by the clock and cannot be held."""
        self._paused = pace == 0
        self._buttons[0].label = "Go on  (P)" if self._paused else "Pause  (P)"
        for each in (*self._buttons, self._choice):
            each.disabled = not lockstep

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
