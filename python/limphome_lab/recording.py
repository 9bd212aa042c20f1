"""messages.lcmlog, an LCM event log, read strictly: LCM's own reader passes over what is damaged without a word."""

import mmap
import struct

from limphome_lab.runfolder import InputError

HEADER = struct.Struct(">IqqII")  # sync word, number, time [us], length of channel and of data
SYNC = 0xEDA1DA01
LONGEST_CHANNEL = 63


class TornRecording(InputError):
    """A recording that does not consist of whole events. What was yielded before is sound."""

    def __init__(self, path, offset):
        super().__init__(
            f"{path}: no whole event at byte {offset}: the run was cut off there, or the file was damaged; "
            "the run can be gone on with by --resume, which cuts it"
        )
        self.offset = offset


def read_log(path, begin=0):
    """Yields (channel, encoded message) of a recording in the order they were written, of a `begin` above 0 from the
    first event that begins at or behind that byte. TornRecording where it ends within an event."""
    for _, channel, data in read_placed(path, begin):
        yield channel, data


def read_placed(path, begin=0):
    """The same as (byte behind the event, channel, encoded message)."""
    with open(path, "rb") as file:
        if file.seek(0, 2) == 0:
            return
        with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
            at = _first_event(content, begin) if begin > 0 else 0
            for _, channel, data, end in _events(path, content, at):
                yield end, channel, data


def is_thinned(path):
    """Whether the controller has dropped events of the middle (recording.limit_mb): their numbers are missing."""
    with open(path, "rb") as file:
        if file.seek(0, 2) == 0:
            return False
        with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
            return any(number != count for count, (number, *_) in enumerate(_events(path, content, 0)))


def _events(path, content, at):
    while at < len(content):
        event = _event(content, at)
        if event is None:
            raise TornRecording(path, at)
        at = event[-1]
        yield event


def _event(content, at):
    """(number, channel, data, where the next begins), or None where there is no whole event."""
    if at + HEADER.size > len(content):
        return None
    sync, number, _, channel_length, data_length = HEADER.unpack_from(content, at)
    middle = at + HEADER.size + channel_length
    end = middle + data_length
    if sync != SYNC or channel_length > LONGEST_CHANNEL or end > len(content):
        return None
    return number, content[at + HEADER.size : middle].decode("ascii", "replace"), content[middle:end], end


def _first_event(content, begin):
    """Where an event begins that another, or the end of the file, follows: a sync word alone may be within data."""
    at = content.find(SYNC.to_bytes(4), begin)
    while at >= 0:
        event = _event(content, at)
        if event and (event[3] == len(content) or _event(content, event[3])):
            return at
        at = content.find(SYNC.to_bytes(4), at + 1)
    return len(content)
