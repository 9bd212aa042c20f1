#!/usr/bin/env python3
"""check_stack.py BOUND OBJECT...: the worst-case stack of every function of the library, from the call graphs and
frames that gcc writes beside each object with -fcallgraph-info=su. Fails on recursion, on a call through a pointer, on
a frame whose size is not known, on a call from outside the library but to copy or fill memory, and where BOUND bytes
are not enough."""

import re
import sys
from pathlib import Path

LEAF_CALLS = {"memcpy", "memset", "memmove", "memcmp"}  # of the compiler; they need next to no stack
RETURN_ADDRESS = 8  # bytes that a call pushes and no frame counts, at most
ALIGNMENT = 64  # bytes that may be lost once, where an array is aligned
NODE = re.compile(r'node: \{ title: "([^"]+)" label: "([^"]*)"')
EDGE = re.compile(r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"')
FRAME = re.compile(r"\\n(\d+) bytes \(([^)]*)\)")


class Refused(Exception):
    """The stack has no bound that could be computed."""


def read(objects):
    """Frames {function: bytes} and calls {function: {function}}."""
    frames, calls = {}, {}
    for file in objects:
        text = Path(file).with_suffix(".ci").read_text()
        for name, label in NODE.findall(text):
            frame = FRAME.search(label)
            if frame is None:
                continue  # defined elsewhere
            if "dynamic" in frame[2] and "bounded" not in frame[2]:
                raise Refused(f"{name}: its frame has no fixed size")
            frames[name] = int(frame[1])
        for caller, callee in EDGE.findall(text):
            calls.setdefault(caller, set()).add(callee)
    return frames, calls


def deepest(function, frames, calls, known, path=()):
    """The most bytes that a call of `function` takes, and the chain of calls that takes them."""
    if function in path:
        raise Refused("recursion: " + " -> ".join([*path, function]))
    if function not in known:
        if function not in frames:
            if function not in LEAF_CALLS:
                raise Refused(f"{path[-1]} calls {function}, which is not in the library")
            return RETURN_ADDRESS, [function]
        below = [deepest(callee, frames, calls, known, (*path, function)) for callee in calls.get(function, ())]
        size, chain = max(below, default=(0, []))
        known[function] = frames[function] + RETURN_ADDRESS + size, [function, *chain]
    return known[function]


def main():
    bound = int(sys.argv[1])
    frames, calls = read(sys.argv[2:])
    if not any(name == "lh_controller_step" for name in frames):
        raise Refused("no call graph of lh_controller_step")
    known = {}
    worst = sorted(
        ((*deepest(name, frames, calls, known), name) for name in frames if name.startswith("lh_")), reverse=True
    )
    for size, chain, name in worst[:5]:
        print(f"{size + ALIGNMENT:6} bytes  {name}: {' > '.join(chain)}")
    print(f"{len(frames)} functions, no recursion; worst {worst[0][0] + ALIGNMENT} of {bound} bytes")
    return 0 if worst[0][0] + ALIGNMENT <= bound else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Refused as reason:
        sys.exit(str(reason))
