"""What a case measures, and what all of them use."""

import math
from dataclasses import asdict, dataclass

from limphome_lab.measure.validation import statics

G = statics.GRAVITY
MU = 0.7  # of paper.ini
SPEED = 0.3  # of the belts, Table 1 [m/s]
QUARTER_TURN_S = 0.5 * math.pi / SPEED  # of the swing joint at its speed of Table 1


@dataclass
class Quantity:
    case: str
    quantity: str
    unit: str
    source: str  # of the reference
    reference: float
    measured: float
    tolerance: float  # largest |measured - reference|, in `unit`

    @property
    def error(self):
        return self.measured - self.reference

    @property
    def passed(self):
        return abs(self.error) <= self.tolerance

    def as_dict(self):
        numbers = {name: float(getattr(self, name)) for name in ("reference", "measured", "tolerance", "error")}
        return asdict(self) | numbers | {"passed": bool(self.passed)}
