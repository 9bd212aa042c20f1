"""A recording along one line of time.

The plant's clock begins anew with each session, as a reset of a simulator does, and when a plant is started again. Here
sessions follow one another: the first keeps the plant's time, each later one begins where the one before ended.
"""

import sys

from limphome_lab.channels import EPISODE, STATE
from limphome_lab.ending import InputError
from limphome_lab.messages import TYPES
from limphome_lab.recording import TornRecording, read_placed


def timeline(path, told=lambda done: None):
    """Yields (time [us], channel, message) in the order they were recorded. The time, that of the newest state or end
    of an episode, never runs back. `told` is called with the bytes read so far.

    What is no message of ours is left out, and so is what follows the first event that is not whole, as a run under way
    may end within one; that is told on stderr. InputError where nothing is left."""
    clock, found = Clock(), False
    try:
        for done, channel, data in read_placed(path):
            told(done)
            message = decoded(channel, data)
            if message is not None:
                if channel == STATE:
                    clock.see(message.session, message.utime, message.utime)
                elif channel == EPISODE:  # the states before it may have been thinned out
                    clock.see(message.session, message.utime, message.utime - round(message.duration * 1e6))
                found = True
                yield clock.now, channel, message
    except TornRecording as torn:
        print(f"{torn}; what lies before is used", file=sys.stderr)
    if not found:
        raise InputError(f"{path}: holds no message of a run")


def decoded(channel, data):
    """The message, or None where it is none of ours."""
    try:
        return TYPES[channel].decode(data) if channel in TYPES else None
    except Exception:  # LCM's decoders raise whatever comes up
        return None


class Clock:
    def __init__(self):
        self.now = 0
        self._session = None
        self._offset = 0

    def see(self, session, utime, begin):
        """What is told of a session at its time `utime`. Where that session is a new one, its time `begin` comes to lie
        where the one before ended."""
        if session != self._session:
            if self._session is not None:
                self._offset = self.now - begin
            self._session = session
        self.now = max(self.now, utime + self._offset)
