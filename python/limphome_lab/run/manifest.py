"""manifest.json: what a run followed from, where it came from, and what it took.

A run that was interrupted and resumed has several parts; each is measured by itself, and the totals are their sums.
"""

import hashlib
import json
import os
import platform
import re
import subprocess
import sys
import time
from collections import Counter
from contextlib import suppress
from pathlib import Path

from limphome_lab import files, paths
from limphome_lab.ending import InputError


class Part:
    """One stretch of a run, from a start of simulator and controller to their end."""

    def __init__(self, folder):
        self.folder = folder
        self.started = time.strftime("%Y-%m-%dT%H:%M:%S%z")
        self._began = time.monotonic()

    def measure(self, result, simulated_s, pair=None):
        """Call when both have ended. `result`: finished, interrupted or failed; `simulated_s`: duration of
        all episodes done; `pair`: the two, unless a single program was all."""
        self.wall_time_s = time.monotonic() - self._began
        part = {
            "started": self.started,
            "command_line": sys.orig_argv,
            "result": result,
            "wall_time_s": round(self.wall_time_s, 3),
            "simulated_time_s": simulated_s,
        }
        if pair is None:
            return part
        part["programs"] = pair.programs
        if pair.restarts:
            part["restarts"] = pair.restarts
        lives = [pair.last_statuses(name) for name in PROCESSES]
        return part | measures(*lives, together=pair.programs == [TOGETHER]) if all(lives) else part


def last_status(recording, name, since):
    """The last status_t of a process in a recording, where it has told one `since` [s, monotonic]; else None."""
    from limphome_lab.messages import STATUS, recorded, status_t  # lcm is there once all is set up, and --help before
    from limphome_lab.recording import TornRecording

    process = {"simulator": status_t.PLANT, "controller": status_t.CONTROLLER}[name]
    last = None
    with suppress(TornRecording, FileNotFoundError):  # what is before the tear is sound; recording_as_it_is tells of it
        for _, status in recorded(recording, STATUS):
            if status.process == process and status.utime >= since * 1e6:
                last = status
    return last


def recording_as_it_is(recording):
    """Its size; the byte at which it was torn, if it was; whether its middle was thinned."""
    from limphome_lab.recording import TornRecording, is_thinned

    if not recording.exists():
        return None
    try:
        return {"bytes": recording.stat().st_size, "thinned": is_thinned(recording)}
    except TornRecording as torn:
        return {"bytes": recording.stat().st_size, "torn_at": torn.offset}


def measures(plant, controller, together=False):
    """What the two say of their own work, by the last status of each of their lives: one that was started again counts
    from nothing. `together`: as one process."""
    return {
        "decisions": sum(each.decisions for each in controller),
        **dict(zip(SHARES, shares(plant, controller, together), strict=True)),
        "counters": {
            name: {counter: sum(getattr(each, counter) for each in lives) for counter in COUNTERS}
            for name, lives in zip(PROCESSES, (plant, controller), strict=True)
        },
    }


def shares(plant, controller, together):
    """Of wall time, in the order of SHARES."""
    plant_waited, controller_waited = (
        sum(each.wait_time for each in lives) / sum(each.wall_time for each in lives) for lives in (plant, controller)
    )
    if together:  # while the controller waits, the plant works, and no message is ever under way
        return controller_waited, 1.0 - controller_waited, 0.0
    # in lockstep one of the two works while the other waits; where both wait, a message is under way
    # the rest; nothing where the two work side by side more than both wait
    return 1.0 - plant_waited, 1.0 - controller_waited, max(0.0, plant_waited + controller_waited - 1.0)


def totals(parts):
    """Sums over the parts that were measured, and what follows from them."""
    measured = [part for part in parts if "decisions" in part]
    if not measured:
        return {}
    wall = sum(part["wall_time_s"] for part in measured)
    simulated = sum(part["simulated_time_s"] for part in measured)
    decisions = sum(part["decisions"] for part in measured)
    return {
        "simulated_time_s": round(simulated, 3),
        "real_time_factor": round(simulated / wall, 2),
        "decisions": decisions,
        "decisions_per_s": round(decisions / wall, 1),
        **{share: round(sum(part[share] * part["wall_time_s"] for part in measured) / wall, 4) for share in SHARES},
    }


PROCESSES = ("simulator", "controller")
TOGETHER = "pair"  # the program that is both in one process
SHARES = ("simulator_share", "controller_share", "link_share")  # of wall time
COUNTERS = (
    "received",
    "rejected_malformed",
    "rejected_non_finite",
    "rejected_session",
    "rejected_sender",
    "rejected_ahead",
    "rejected_challenge",
    "duplicates",
    "resent",
    "late",
    "stale",
    "limited",
    "overruns",
    "clamped",
    "clamped_inputs",
    "clamped_temperatures",
    "clamped_margins",
    "clamped_weights",
    "clamped_widths",
    "clamped_centres",
    "interventions",
    "stilled_actuators",
    "saturated",
    "faults",
)


TRAINING, EVALUATION = "training", "evaluation"


def begin_manifest(folder, config, programs=(), kind=TRAINING):
    """Notes what kind of run it is and the name of the experiment, before anything has run; `programs`: those that no
    part will name."""
    begun = {"kind": kind, "config": config, "programs": programs, "parts": []}
    files.replace(folder.manifest, json.dumps(begun) + "\n")


def read_manifest(folder):
    """What is kept of it when a part is added; InputError where somebody changed it."""
    try:
        read = json.loads(folder.manifest.read_text())
        begun = {key: read[key] for key in ("kind", "config", "programs", "parts")}
        _check_types(begun)
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(f"{folder.manifest}: is no manifest of a run") from error
    return begun


def _check_types(begun):
    """TypeError or KeyError where something is not what write_manifest would reckon with."""

    def check(value, kind):
        if not isinstance(value, kind):
            raise TypeError(value)

    for key, kind in (("kind", str), ("config", str), ("programs", list), ("parts", list)):
        check(begun[key], kind)
    for name in begun["programs"]:
        check(name, str)
    for part in begun["parts"]:
        check(part, dict)
        measured = ("simulated_time_s", "decisions", *SHARES) if "decisions" in part else ()
        for key in ("wall_time_s", *measured):
            check(part[key], (int, float))
        check(part.get("restarts", []), list)
        check(part.get("programs", []), list)


def write_manifest(folder, part):
    """Adds a part to manifest.json and brings all else in it up to date."""
    begun = read_manifest(folder)
    parts = begun["parts"] + [part]
    programs = list(dict.fromkeys([*begun["programs"], *part.get("programs", ())]))
    episodes = folder.read_episodes()
    manifest = {
        "kind": begun["kind"],
        "config": begun["config"],
        "programs": programs,
        "seed": int(folder.settings()["learning"]["seed"]),
        "settings": as_dict(folder.settings()),
        "digests": {"robot": digest(folder.robot), **program_digests(programs)},
        "result": part["result"],
        "episodes": len(episodes),
        "outcomes": dict(Counter(episode.outcome for episode in episodes)),
        "recording": recording_as_it_is(folder.messages),
        "restarts": sum(len(each.get("restarts", ())) for each in parts),
        "wall_time_s": round(sum(each["wall_time_s"] for each in parts), 3),
        **totals(parts),
        "versions": versions(),
        "revision": revision(),
        "machine": {"os": os_name(), "kernel": platform.release(), "cpu": cpu_name(), "cores": os.cpu_count()},
        "parts": parts,
    }
    files.replace(folder.manifest, json.dumps(manifest, indent=2) + "\n")


def as_dict(settings):
    """{section: {key: value}} of a configparser."""
    return {section: dict(settings[section]) for section in settings.sections()}


def digest(file):
    return hashlib.sha256(Path(file).read_bytes()).hexdigest()


def program_digests(programs):
    return {name: digest(paths.program(name)) for name in programs}


def output(*command):
    """First line a command prints, or None where it cannot be had."""
    try:
        result = subprocess.run(command, capture_output=True, text=True, cwd=paths.ROOT)
    except FileNotFoundError:
        return None
    return result.stdout.partition("\n")[0].strip() or None if result.returncode == 0 else None


def versions():
    version = output(paths.program("controller"), "--version")
    return {
        "limphome": version and version.split()[-1],
        "lcm": output("pkg-config", "--modversion", "lcm"),
        "bullet": output("pkg-config", "--modversion", "bullet"),
        "compiler": output(cmake_cache("CMAKE_CXX_COMPILER") or "c++", "--version"),
        "build_type": cmake_cache("CMAKE_BUILD_TYPE"),
        "python": platform.python_version(),
    }


def cmake_cache(name):
    cache = paths.BUILD / "CMakeCache.txt"
    found = re.search(rf"^{name}:\w+=(.*)$", cache.read_text(), re.MULTILINE) if cache.exists() else None
    return found and found.group(1)


def revision():
    """Of the source tree; that of the working directory where the package is installed would say nothing."""
    # also of a tree that is somebody else's: who runs its scripts trusts it
    git = ["git", "-c", f"safe.directory={paths.ROOT}"]
    commit = output(*git, "rev-parse", "HEAD") if paths.IN_TREE else None
    return {"commit": commit, "dirty": bool(output(*git, "status", "--porcelain")) if commit else None}


def os_name():
    found = re.search(r'^PRETTY_NAME="?([^"\n]*)', Path("/etc/os-release").read_text(), re.MULTILINE)
    return found.group(1) if found else platform.system()


def cpu_name():
    found = re.search(r"^model name\s*:\s*(.*)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    return found.group(1) if found else platform.machine()
