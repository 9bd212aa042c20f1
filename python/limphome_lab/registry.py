"""Pairs of simulator and controller that are running now, so that others can find and join them.

One JSON file per pair in the user's runtime directory: {pid, start, run, url}. A file whose process is gone, or whose
process id now belongs to another, is ignored and removed.
"""

import json
import os
from pathlib import Path

from limphome_lab import files
from limphome_lab.ending import Ending


def directory():
    runtime = os.environ.get("XDG_RUNTIME_DIR")
    path = Path(runtime) / "limphome" if runtime and Path(runtime).is_dir() else Path(f"/tmp/limphome-{owner()}")
    path.mkdir(mode=0o700, parents=True, exist_ok=True)
    if path.stat().st_uid != os.geteuid():
        raise Ending(f"{path} belongs to another user; remove it, or set XDG_RUNTIME_DIR to a folder of your own")
    return path


def owner():
    """The user outside of any user namespace: inside of a run's network everybody is called root."""
    inner, outer, _ = Path("/proc/self/uid_map").read_text().split()[:3]
    return int(outer) + os.geteuid() - int(inner)


def process_start(pid):
    """When a process started [clock ticks after boot]; with the pid it names a process for good. None if it is gone."""
    try:
        return int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[19])
    except (FileNotFoundError, ProcessLookupError):
        return None


def register(run, url):
    """Announces the calling process as a pair that is running; returns the file to remove at its end."""
    pid = os.getpid()
    entry = directory() / f"{pid}.json"
    files.replace(entry, json.dumps({"pid": pid, "start": process_start(pid), "run": str(run), "url": url}))
    return entry


def running():
    """Entries of the pairs that are running, the newest first."""
    found = []
    for file in directory().glob("*.json"):
        try:
            entry = json.loads(file.read_text())
            alive = process_start(entry["pid"]) == entry["start"] is not None
        except (ValueError, KeyError, FileNotFoundError):
            alive = False
        if alive:
            found.append(entry)
        else:
            file.unlink(missing_ok=True)
    return sorted(found, key=lambda entry: entry["start"], reverse=True)
