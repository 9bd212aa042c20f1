"""The messages as a page: what stands in the .lcm files, type by type, and the channels of limphome_channels.h."""

import re
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Member:
    name: str
    kind: str
    said: str


@dataclass
class Type:
    name: str
    said: str
    fields: list = field(default_factory=list)
    constants: list = field(default_factory=list)


def read(text):
    """The types of an .lcm file. A comment belongs to what follows it."""
    types, said = [], []
    for line in map(str.strip, text.splitlines()):
        if line.startswith("//"):
            said.append(line.removeprefix("//").strip())
            continue
        comment = " ".join(said)
        if line in ("", "{", "}") or line.startswith("package "):
            continue
        if match := re.match(r"struct (\w+)", line):
            types.append(Type(match[1], comment))
        elif match := re.match(r"const (\w+) (.+);", line):
            types[-1].constants += [Member(*map(str.strip, each.split("=")), comment) for each in match[2].split(",")]
        elif match := re.match(r"([\w.]+) (\w+)((?:\[\w+\])*);", line):
            types[-1].fields.append(Member(match[2], match[1] + match[3], comment))
        else:
            raise ValueError(f"not understood: {line}")
        said = []
    return types


def page(folder):
    lines = [
        "# Messages",
        "",
        "Every message type, as in `lcmtypes/*.lcm`. Units are SI, times microseconds. How they are exchanged is",
        "told in [the protocol](../docs/protocol.md).",
    ]
    for file in sorted(Path(folder).glob("*.lcm")):
        for each in read(file.read_text()):
            lines += ["", f"## {each.name}", "", each.said, "", f"From [{file.name}](../lcmtypes/{file.name}).", ""]
            lines += ["| field | type | meaning |", "|---|---|---|"]
            lines += [f"| `{one.name}` | `{one.kind}` | {_cell(one.said)} |" for one in each.fields]
            if each.constants:
                lines += ["", "| constant | value | meaning |", "|---|---|---|"]
                lines += [f"| `{one.name}` | {one.kind} | {_cell(one.said)} |" for one in each.constants]
    return "\n".join(lines) + "\n"


def _cell(text):
    return text.replace("|", "\\|").replace("<", "&lt;").replace("*", "\\*").replace("_", "\\_")
