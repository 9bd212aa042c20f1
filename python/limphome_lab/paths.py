"""Where things are: in a source tree and its build, or where pip and `cmake --install` have put them."""

import itertools
import os
import shutil
import sys
import time
from pathlib import Path

from limphome_lab.ending import Ending

_TREE = Path(__file__).resolve().parents[2]
IN_TREE = (_TREE / "lcmtypes").is_dir()
ROOT = _TREE if IN_TREE else Path.cwd()  # what is made lies below it
BUILD = Path(os.environ.get("LIMPHOME_BUILD", ROOT / "build"))
_MADE = ROOT if os.access(ROOT, os.W_OK) else Path.home() / "limphome"  # the tree may be somebody else's
RUNS = _MADE / "runs"
STUDIES = _MADE / "studies"


def _shared():
    """Folder of the files that come along: the tree's, else beside the controller in PATH."""
    if IN_TREE:
        return _TREE
    controller = shutil.which("limphome-controller")
    prefix = Path(controller).resolve().parents[1] if controller else Path(sys.prefix)
    return prefix / "share" / "limphome"


CONFIG = _shared() / "config"
LCMTYPES = _shared() / "lcmtypes"


def program(name):
    """File of the program limphome-NAME: the build's, else the first in PATH."""
    places = os.pathsep.join([str(BUILD / "bin"), os.environ.get("PATH", os.defpath)])
    found = shutil.which(f"limphome-{name}", path=places)
    if found is None:
        raise Ending(f"limphome-{name} is neither in {BUILD}/bin nor in PATH; LIMPHOME_BUILD can name a build")
    return Path(found)


def library(name):
    """File of the shared library limphome_NAME, which comes along with the programs."""
    programs = program("controller").resolve().parent
    file = programs.parent / "lib" / "limphome" / f"liblimphome_{name}.so"
    if not file.is_file():
        raise Ending(f"{file} is missing beside the programs in {programs}; build or install them anew")
    return file


def new_run(name):
    """A folder below runs/ that is not there yet, named after what runs and the time; another may begin this second."""
    stem = f"{name}-{time.strftime('%Y%m%d-%H%M%S')}"
    candidates = (RUNS / (stem if n == 1 else f"{stem}-{n}") for n in itertools.count(1))
    return next(path for path in candidates if not path.exists())


def shown(path):
    """`path` as a person would type it: relative where it lies below the working directory, if that is still there."""
    try:
        return str(Path(path).absolute().relative_to(Path.cwd()))
    except (FileNotFoundError, ValueError):
        return str(path)
