"""Makes the scripts' package and the generated messages importable."""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("LIMPHOME_BUILD", ROOT / "build"))
sys.path[:0] = [str(ROOT / "scripts"), str(BUILD / "python")]
