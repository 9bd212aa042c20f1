"""Files that survive a fault at any moment: replaced whole or not at all."""

import contextlib
import os
from pathlib import Path


def replace(path, content):
    """Puts bytes, or a text, in the place of the file `path`: written beside it, brought to the disk, renamed."""
    path = Path(path)
    fresh = path.with_name(path.name + ".new")
    try:
        with open(fresh, "wb") as file:
            file.write(content.encode() if isinstance(content, str) else content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(fresh, path)
    except OSError as error:
        fresh.unlink(missing_ok=True)
        raise OSError(error.errno, error.strerror, str(path)) from error
    folder = os.open(path.parent, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(folder)
    finally:
        os.close(folder)


@contextlib.contextmanager
def replacing(path):
    """Gives the path of a file to write that takes the place of `path` at the end, unless that fails."""
    path = Path(path)
    fresh = path.with_name(path.name + ".new")
    try:
        yield fresh
        os.replace(fresh, path)
    finally:
        fresh.unlink(missing_ok=True)
