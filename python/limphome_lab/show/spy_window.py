"""lcm-spy with our message types.

The distribution's lcm-spy does not start on Java 17; the one in the Python package lcm does, and brings its jars.
"""

import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import lcm

from limphome_lab import command, paths
from limphome_lab.runfolder import InputError
from limphome_lab.show import display

JARS = Path(lcm.__file__).resolve().parents[1] / "share" / "java"
CACHE = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "limphome"


def window_command(url, inside):
    """The command that opens the window on `url`; `inside` is what starts it within the run's network."""
    as_text = f"{command.called('spy')} --text"
    if not os.environ.get("DISPLAY"):
        raise InputError(f"there is no display (DISPLAY is not set); use {as_text}")
    if shutil.which("javac") is None:
        raise InputError(f"a Java development kit is needed: apt-get install default-jdk; or use {as_text}")
    if inside:
        display.reachable_from(inside)
    # lcm-spy looks through the class path for message types, so that holds ours alone
    return [
        "java",
        "-Djava.net.preferIPv4Stack=true",
        f"-Xbootclasspath/a:{libraries()}",
        "-cp",
        str(types_jar()),
        "lcm.spy.Spy",
        f"--lcm-url={url}",
    ]


def libraries():
    return os.pathsep.join(map(str, sorted(JARS.glob("*.jar"))))


def types_jar():
    """The message types for Java, compiled once for each state that they are in: dates of files do not tell of it."""
    types = sorted(paths.LCMTYPES.glob("*.lcm"))
    state = hashlib.sha256(b"".join(file.read_bytes() for file in types)).hexdigest()[:16]
    jar = CACHE / f"types-{state}.jar"
    if not jar.exists():
        print("compiling the message types for lcm-spy", file=sys.stderr)
        CACHE.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=CACHE) as work:
            _compile(types, Path(work)).replace(jar)
    return jar


def _compile(types, work):
    classes = work / "classes"
    classes.mkdir()
    _run("lcm-gen", "-j", "--jpath", work / "source", *types)
    _run("javac", "-cp", JARS / "lcm.jar", "-d", classes, *sorted((work / "source").rglob("*.java")))
    _run("jar", "cf", work / "types.jar", "-C", classes, ".")
    return work / "types.jar"


def _run(*words):
    result = subprocess.run(words, capture_output=True, text=True)
    if result.returncode != 0:
        raise InputError(f"{words[0]} failed:\n{result.stderr or result.stdout}")
