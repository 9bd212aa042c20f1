"""Where things are: the source tree, the build and the programs."""

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("LIMPHOME_BUILD", ROOT / "build"))
SIMULATOR = BUILD / "bin" / "limphome-simulator"
CONTROLLER = BUILD / "bin" / "limphome-controller"
CONFIG = ROOT / "config"
RUNS = ROOT / "runs"


def shown(path):
    """`path` as a person would type it: relative where it lies below the working directory."""
    path = Path(path).absolute()
    return str(path.relative_to(Path.cwd())) if path.is_relative_to(Path.cwd()) else str(path)
