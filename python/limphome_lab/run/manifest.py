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
from pathlib import Path

from limphome_lab import paths


class Part:
    """One stretch of a run, from a start of the two processes to their end."""

    def __init__(self, folder):
        self.folder = folder
        self.before = last_statuses(folder.messages)
        self.started = time.strftime("%Y-%m-%dT%H:%M:%S%z")
        self._began = time.monotonic()

    def measure(self, result, simulated_s):
        """Call when both processes have ended. `result`: finished, interrupted or failed; `simulated_s`: duration of
        all episodes done."""
        self.wall_time_s = time.monotonic() - self._began
        part = {
            "started": self.started,
            "command_line": sys.orig_argv,
            "result": result,
            "wall_time_s": round(self.wall_time_s, 3),
            "simulated_time_s": simulated_s,
        }
        statuses = last_statuses(self.folder.messages)
        new = [
            statuses[process]
            for process in PROCESSES
            if process in statuses and not _equal(statuses[process], self.before.get(process))
        ]
        return part | measures(*new) if len(new) == 2 else part


def _equal(status, other):
    return other is not None and status.encode() == other.encode()


def last_statuses(recording):
    """The last status_t of each process in a recording, by its name in PROCESSES, where there is one."""
    from limphome_lab.messages import STATUS, recorded, status_t  # lcm is there once all is set up, and --help before

    if not recording.exists():
        return {}
    names = dict(zip((status_t.PLANT, status_t.CONTROLLER), PROCESSES, strict=True))
    return {names[status.process]: status for _, status in recorded(recording, STATUS) if status.process in names}


def measures(plant, controller):
    """What the two processes say of their own work."""
    simulator_share, controller_share = (
        (each.wall_time - each.wait_time) / each.wall_time for each in (plant, controller)
    )
    return {
        "decisions": controller.decisions,
        "simulator_share": simulator_share,
        "controller_share": controller_share,
        # in lockstep one of the two works while the other waits; where both wait, a message is under way
        # the rest; nothing where the two work side by side more than both wait
        "link_share": max(0.0, 1.0 - simulator_share - controller_share),
        "counters": {
            name: {counter: getattr(status, counter) for counter in COUNTERS}
            for name, status in zip(PROCESSES, (plant, controller), strict=True)
        },
    }


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
SHARES = ("simulator_share", "controller_share", "link_share")  # of wall time
COUNTERS = (
    "received",
    "rejected_malformed",
    "rejected_non_finite",
    "rejected_session",
    "rejected_sender",
    "duplicates",
    "resent",
    "late",
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


def begin_manifest(folder, config, programs=PROCESSES):
    """Notes the name of the experiment, before anything has run."""
    folder.manifest.write_text(json.dumps({"config": config, "programs": programs, "parts": []}) + "\n")


def write_manifest(folder, part):
    """Adds a part to manifest.json and brings all else in it up to date."""
    begun = json.loads(folder.manifest.read_text())
    parts = begun["parts"] + [part]
    episodes = folder.read_episodes()
    manifest = {
        "config": begun["config"],
        "programs": begun["programs"],
        "seed": int(folder.settings()["learning"]["seed"]),
        "settings": as_dict(folder.settings()),
        "digests": {"robot": digest(folder.robot), **program_digests(begun["programs"])},
        "result": part["result"],
        "episodes": len(episodes),
        "outcomes": dict(Counter(episode.outcome for episode in episodes)),
        "wall_time_s": round(sum(each["wall_time_s"] for each in parts), 3),
        **totals(parts),
        "versions": versions(),
        "revision": revision(),
        "machine": {"os": os_name(), "kernel": platform.release(), "cpu": cpu_name(), "cores": os.cpu_count()},
        "parts": parts,
    }
    folder.manifest.write_text(json.dumps(manifest, indent=2) + "\n")


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
    commit = output("git", "rev-parse", "HEAD") if paths.IN_TREE else None
    return {"commit": commit, "dirty": bool(output("git", "status", "--porcelain")) if commit else None}


def os_name():
    found = re.search(r'^PRETTY_NAME="?([^"\n]*)', Path("/etc/os-release").read_text(), re.MULTILINE)
    return found.group(1) if found else platform.system()


def cpu_name():
    found = re.search(r"^model name\s*:\s*(.*)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    return found.group(1) if found else platform.machine()
