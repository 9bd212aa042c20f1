"""Who works in a run folder. Its file `lock` has a byte for each role: whoever has one holds a lock of fcntl on it
until it ends, however it ends. The scripts hold the first byte, the controller the second
(controller/app/folder_lock.h)."""

import fcntl
import os
import struct
import time

from limphome_lab.ending import InputError

SCRIPT_BYTE, CONTROLLER_BYTE = 0, 1
FLOCK = struct.Struct("hhqqi4x")  # struct flock of Linux on 64 bits: type, whence, start, length, pid
LEAVING_S = 15.0  # for a controller whose script was killed to end


def take(path):
    """Takes the scripts' part; returns the open file that holds it. InputError, naming the process that is there, where
    another script, or a controller that does not end, works in the folder."""
    file = open(path, "a+b")  # noqa: SIM115
    try:
        fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB, 1, SCRIPT_BYTE)
    except BlockingIOError:
        _refuse(path, _holder(file, SCRIPT_BYTE))
    deadline = time.monotonic() + LEAVING_S
    while (pid := _holder(file, CONTROLLER_BYTE)) is not None:
        if time.monotonic() > deadline:
            _refuse(path, pid)
        time.sleep(0.05)
    return file


def _holder(file, byte):
    """Id of the process that holds the lock; None where nobody does."""
    question = FLOCK.pack(fcntl.F_WRLCK, os.SEEK_SET, byte, 1, 0)
    kind, _, _, _, pid = FLOCK.unpack(fcntl.fcntl(file, fcntl.F_GETLK, question))
    return None if kind == fcntl.F_UNLCK else pid


def _refuse(path, pid):
    raise InputError(f"{path.parent}: process {pid} works in this folder")
