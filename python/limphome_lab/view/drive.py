"""The panel by which a person drives the robot by hand, an actuator at a time or several.

A direction holds for as long as its button is held, or a moment longer than its key was pressed: a browser that hangs
lets the robot stand still.
"""

import time

from limphome_lab.run import hand
from limphome_lab.view.told import spoken

BUTTON_HELD_S = 0.35  # a held button calls ten times a second
KEY_HELD_S = 0.7  # a key repeats, but first after half a second
# forward and reverse of each actuator; no other command has them
KEYS = ("QA", "WS", "ED", "TG", "YB", "UJ", "IK", "OV")
IN_CHARGE = {**hand.WORDS, None: "nothing is known of who drives"}


class Drive:
    """Puts its panel where the caller's `with` is. `ask(asked)` sends what limphome_lab.view.operate obeys."""

    def __init__(self, gui, ask, later):
        self.gui, self.ask, self.later = gui, ask, later
        self._text = gui.add_markdown("")
        self._said = []
        self._told = {"in_charge": None, "armed": False}
        self._held = {}  # {actuator: (direction, until when)}
        self._sent = []
        self._button("Take the robot by hand", "H", lambda: self._do("take"))
        self._button("Limp home: give it to the learner", "L", lambda: self._do("give"))
        self._arm = self._button("Arm", "M", lambda: self._do("disarm" if self._told["armed"] else "arm"))
        self._folder = gui.add_folder("hold to move")
        self._parts = []
        self._show()

    def fit(self, actuators):
        """To a robot with these actuators."""
        for each in self._parts:
            each.remove()
        self._parts, self._held, self._sent, self._said = [], {}, [], []
        self._told = {"in_charge": None, "armed": False}
        with self._folder:
            for index, name in enumerate(actuators):
                for key, direction, words in zip(KEYS[index], (1, -1), ("forward", "reverse"), strict=True):
                    self._add_move(index, direction, f"{spoken(name)} {words}", key)
        self._show()

    def hear(self, told):
        if "say" in told:
            self._said = [*self._said[-3:], told["say"]]
        else:
            self._told = told
            self._arm.label = "Disarm  (M)" if told["armed"] else "Arm  (M)"
        self._show()

    def keep(self):
        """Call often while the page is open."""
        now = time.monotonic()
        self._held = {index: held for index, held in self._held.items() if held[1] > now}
        wanted = [self._held.get(index, (0,))[0] for index in range(len(KEYS))]
        if self._told["in_charge"] == hand.ME and wanted != self._sent:
            self._sent = wanted
            self.ask({"drive": wanted})

    def let_go(self):
        """Nobody is there any more."""
        self._held = {}
        self.keep()

    def _do(self, what):
        self._held, self._sent = {}, []
        self.ask({"do": what})

    def _button(self, label, key, action):
        button = self.gui.add_button(f"{label}  ({key})")
        button.on_click(lambda _: self.later(action))
        self.gui.add_command(label, hotkey=key).on_trigger(lambda _: self.later(action))
        return button

    def _add_move(self, index, direction, label, key):
        def hold(seconds):
            self.later(lambda: self._held.update({index: (direction, time.monotonic() + seconds)}))

        button = self.gui.add_button(f"{label}  ({key})", color="gray")
        button.on_hold(lambda _: hold(BUTTON_HELD_S))
        shortcut = self.gui.add_command(label, hotkey=key)
        shortcut.on_trigger(lambda _: hold(KEY_HELD_S))
        self._parts += [button, shortcut]

    def _show(self):
        armed = "armed" if self._told["armed"] else "not armed by this page"
        said = "".join(f"\n- {words}" for words in self._said)
        self._text.content = (
            f"**{IN_CHARGE[self._told['in_charge']]}**; {armed}\n\n"
            "In lockstep choose pace 1 before you take it; in real time arm it. Hold several keys to move several."
            f"\n{said}"
        )
