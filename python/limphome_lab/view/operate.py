"""The operator's side of a viewer, inside the network of the pair: arming and driving by hand, as the page asks for.

What the page says and hears goes through the feed, as messages on channels that are not on the bus.
"""

import contextlib
import json

from limphome_lab.run.arming import Operator
from limphome_lab.run.hand import Hand

ASKED = "view/asked"  # JSON: {"do": "take" | "give" | "arm" | "disarm"} or {"drive": [-1 | 0 | 1, ...]}
TOLD = "view/told"  # JSON: {"say": words} or {"in_charge": one of limphome_lab.run.hand, "armed": whether it is}


class Operating:
    """Begins to listen once a person has asked for something: liblcm costs a pair that runs free."""

    def __init__(self, url, tell):
        self._url, self._tell = url, tell
        self._open = contextlib.ExitStack()
        self._operator = self._hand = None
        self._told = None

    def obey(self, asked):
        if self._hand is None:
            self._operator = self._open.enter_context(Operator(self._url, self._say))
            self._hand = self._open.enter_context(Hand(self._url, self._say))
        if "drive" in asked:
            self._hand.drive(asked["drive"])
        elif asked["do"] == "take":
            self._hand.take()
        elif asked["do"] == "give":
            self._hand.give()
        elif (asked["do"] == "arm") != (self._operator.armed or self._operator.wants_armed):
            self._operator.toggle()

    def answer(self):
        """Keeps up what was asked for. Call often."""
        if self._hand is None:
            return
        self._operator.answer()
        self._hand.answer()
        told = {"in_charge": self._hand.in_charge, "armed": self._operator.armed}
        if told != self._told:
            self._told = told
            self._tell(TOLD, json.dumps(told).encode())

    def let_go(self):
        """Disarms what it has armed, and keeps nothing up."""
        self._open.close()
        self._operator = self._hand = None

    def _say(self, words):
        self._tell(TOLD, json.dumps({"say": words}).encode())
