"""What was learned, as encoded messages whose last four bytes are a checksum: CRC-32 of all bytes before them."""

import zlib

from limphome_lab.runfolder import InputError

LENGTH = 4


def seal(message):
    """Encodes a message of such a type."""
    content = message.encode()[:-LENGTH]
    return content + zlib.crc32(content).to_bytes(LENGTH)


def unseal(kind, data, source):
    """The message of type `kind` in `data`; InputError, naming `source`, where it is of another or was damaged."""
    try:
        message = kind.decode(data)
    except Exception as error:  # LCM's decoders raise whatever comes up
        raise InputError(f"{source}: is no {kind.__name__} of this version") from error
    if zlib.crc32(data[:-LENGTH]) != int.from_bytes(data[-LENGTH:]) or len(data) != len(message.encode()):
        raise InputError(f"{source}: does not match its checksum (damaged)")
    return message
