"""build.py OUT: the documentation as pages, from what lies in the tree. Uses no network.

Sphinx reads a copy of the tree, where links among pages and to source files lead where they do on a forge, and pages
that are made here: the messages, and the interfaces in C and Python.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import messages

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
WORK = Path(os.environ["LIMPHOME_BUILD"]) / "site"
PAGES = (
    "README.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "CITATION.cff",
    "LICENSE",
    "CMakeLists.txt",
    "CMakePresets.json",
)
FOLDERS = (
    "config",
    "controller",
    "docs",
    "examples",
    "lcmtypes",
    "pair",
    "python",
    "robot",
    "scripts",
    "simulator",
    "test",
)
SECTIONS = "briefdescription detaileddescription innerclass public-attrib define enum typedef func var"
ROOMS = {
    "": "The controller: one call per decision",
    "base": "What all else uses: capacities, errors, vectors, random numbers",
    "body": "The robot, its posture, what it stands on, its stability margin",
    "task": "What is seen, rewarded and ended",
    "learning": "How it learns and chooses",
    "safety": "What may still be taken away",
}


def stage():
    """The folder that Sphinx reads."""
    source = WORK / "source"
    shutil.rmtree(source, ignore_errors=True)
    source.mkdir(parents=True)
    for name in PAGES:
        shutil.copy(ROOT / name, source)
    for name in FOLDERS:
        shutil.copytree(ROOT / name, source / name, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(HERE / "index.md", source)
    reference = source / "reference"
    shutil.copytree(HERE / "reference", reference)
    (reference / "messages.md").write_text(messages.page(ROOT / "lcmtypes"))
    (reference / "c.md").write_text(c_page())
    return source


def c_page():
    """The library's interface, header by header, in the order in which rooms use each other."""
    hidden = {"exponential.h", "lanes.h"}  # not installed
    lines = ["# The library in C", "", (HERE / "c.md").read_text()]
    for room, said in ROOMS.items():
        lines += ["", f"## {said}", ""]
        for header in sorted((ROOT / "controller" / "limphome" / room).glob("*.h")):
            if header.name not in hidden:
                name = header.relative_to(ROOT / "controller")
                lines += [
                    f"### {name}",
                    "",
                    "```{doxygenfile} " + header.name,
                    f":sections: {SECTIONS}",
                    "```",
                    "",
                ]
    return "\n".join(lines)


def doxygen():
    """The headers' comments as XML, for breathe."""
    folder = WORK / "doxygen"
    folder.mkdir(parents=True, exist_ok=True)
    settings = (ROOT / "controller" / "Doxyfile").read_text()
    settings += f"""
INPUT = controller/limphome
OUTPUT_DIRECTORY = {folder}
GENERATE_HTML = NO
GENERATE_XML = YES
TYPEDEF_HIDES_STRUCT = YES
"""
    subprocess.run(["doxygen", "-"], cwd=ROOT, input=settings, text=True, check=True)


def main():
    out = Path(sys.argv[1]).absolute()
    doxygen()
    environment = {**os.environ, "LIMPHOME_SITE": str(WORK)}
    options = ["-c", HERE, "-d", WORK / "doctrees", "-b", "html", "-W", "--keep-going", "-q"]
    return subprocess.run([sys.executable, "-m", "sphinx", *options, stage(), out], env=environment).returncode


if __name__ == "__main__":
    sys.exit(main())
