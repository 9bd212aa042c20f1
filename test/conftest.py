"""Makes the package limphome_lab and the generated messages importable, here and in what the tests start."""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD = Path(os.environ.get("LIMPHOME_BUILD", ROOT / "build"))
PACKAGES = [str(ROOT / "python"), str(BUILD / "python")]
sys.path[:0] = PACKAGES
os.environ["PYTHONPATH"] = os.pathsep.join(PACKAGES)
