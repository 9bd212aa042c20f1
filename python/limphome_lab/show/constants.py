"""Names of the constants that a field of a message may have, by the .lcm files: they stand below the field."""

import functools
import re

from limphome_lab import paths

FIELD = re.compile(r"^\s*(?:int\d+_t|double)\s+(\w+)(?:\[\w+\])*\s*;")
CONSTANTS = re.compile(r"^\s*const\s+(?:int\d+_t|double)\s+(.*?);")
FLAGS = "sum of the constants"  # as the comment above a field says


@functools.cache
def of_type(name):
    """{field: ({value: name}, whether its values are sums of them)} of limphome_NAME.lcm; of message type robot_state_t
    the name is robot_state."""
    file = paths.LCMTYPES / f"limphome_{name}.lcm"
    found, field, comment = {}, None, ""
    for line in file.read_text().splitlines() if file.exists() else ():
        if line.strip().startswith("//"):
            comment = f"{comment} {line.strip().lstrip('/ ')}"
            continue
        declared, constants = FIELD.match(line), CONSTANTS.match(line)
        if constants and field:
            for each in constants[1].split(","):
                constant, _, value = each.partition("=")
                found.setdefault(field[0], ({}, FLAGS in field[1]))[0][float(value)] = constant.strip()
        elif line.strip():
            field = (declared[1], comment) if declared else None
            comment = ""
    return found


def named(type_name, field, value):
    """The constant's name, of a sum those of its parts; None where there is none for this value."""
    names, is_sum = of_type(type_name).get(field, ({}, False))
    if not is_sum or value in names:
        return names.get(value)
    bits = [int(bit) for bit in names if int(bit) & value]
    return " + ".join(names[bit] for bit in bits) if bits and sum(bits) == value else None
