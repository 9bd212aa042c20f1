"""Recordings that tests make."""

import lcm

from limphome_lab.messages import TYPES


def message(channel, **fields):
    """(channel, message) with these fields."""
    made = TYPES[channel]()
    for name, value in fields.items():
        assert hasattr(made, name)
        setattr(made, name, value)
    return channel, made


def write(path, messages):
    """Writes (channel, message) as an LCM event log."""
    log = lcm.EventLog(str(path), "w", overwrite=True)
    for number, (channel, made) in enumerate(messages):
        log.write_event(number, channel, made.encode())
    log.close()
