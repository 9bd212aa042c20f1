"""lcm-spy with our message types.

The distribution's lcm-spy does not start on Java 17; the one in the Python package lcm does, and brings its jars.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import lcm

from limphome_lab import command, paths
from limphome_lab.runfolder import InputError

JARS = Path(lcm.__file__).resolve().parents[1] / "share" / "java"
CACHE = paths.BUILD if paths.IN_TREE else Path.home() / ".cache" / "limphome"
TYPES = CACHE / "java" / "limphome-types.jar"


def window_command(url):
    """The command that opens the window on `url`; its jar of types is made where it is missing or old."""
    as_text = f"{command.called('spy')} --text"
    if not os.environ.get("DISPLAY"):
        raise InputError(f"there is no display (DISPLAY is not set); use {as_text}")
    if shutil.which("javac") is None:
        raise InputError(f"a Java development kit is needed: apt-get install default-jdk; or use {as_text}")
    make_types_jar()
    # lcm-spy looks through the class path for message types, so that holds ours alone
    libraries = os.pathsep.join(map(str, sorted(JARS.glob("*.jar"))))
    return [
        "java",
        "-Djava.net.preferIPv4Stack=true",
        f"-Xbootclasspath/a:{libraries}",
        "-cp",
        str(TYPES),
        "lcm.spy.Spy",
        f"--lcm-url={url}",
    ]


def make_types_jar():
    types = sorted(paths.LCMTYPES.glob("*.lcm"))
    if TYPES.exists() and TYPES.stat().st_mtime > max(file.stat().st_mtime for file in [paths.LCMTYPES, *types]):
        return
    print("compiling the message types for lcm-spy", file=sys.stderr)
    work = TYPES.parent
    shutil.rmtree(work, ignore_errors=True)
    classes = work / "classes"
    classes.mkdir(parents=True)
    _run("lcm-gen", "-j", "--jpath", work / "source", *types)
    _run("javac", "-cp", JARS / "lcm.jar", "-d", classes, *sorted((work / "source").rglob("*.java")))
    _run("jar", "cf", TYPES, "-C", classes, ".")


def _run(*command):
    result = subprocess.run(command, capture_output=True, text=True)
    if result.returncode != 0:
        raise InputError(f"{command[0]} failed:\n{result.stderr or result.stdout}")
