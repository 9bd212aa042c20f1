"""Figures of scripts/bench against those of an earlier run of it: what got worse."""

import json

from limphome_lab.ending import InputError

TOLERANCE = 0.2  # share of a ratio that it may lose: what it varies by from run to run on a shared machine


def read(path):
    """{name: ratio} of a file that `scripts/bench --json` has written."""
    try:
        figures = json.loads(path.read_text(), parse_int=float)
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from error
    except (ValueError, RecursionError) as error:
        raise InputError(f"{path}: not what scripts/bench --json writes: {error}") from error
    try:
        ratios = {figure["name"]: figure["ratio"] for figure in figures}
    except (TypeError, KeyError) as error:
        raise InputError(
            f"{path}: not what scripts/bench --json writes: a list of figures, each with name and ratio"
        ) from error
    for name, ratio in ratios.items():
        if not isinstance(name, str):
            raise InputError(f"{path}: name {name!r}: must be a text")
        if not isinstance(ratio, float) or not 0 < ratio < float("inf"):
            raise InputError(f"{path}: ratio of {name} is {ratio!r}: must be a number above 0")
    if not ratios:
        raise InputError(f"{path}: holds no figure")
    return ratios


def compare(before, now):
    """`before` and `now`: {name: ratio}. Lines for people, and the names of what got worse beyond the tolerance."""
    width = max(map(len, before | now))
    lines = [f"{'name':<{width}}  before     now  change"]
    worse = []
    for name, ratio in now.items():
        if name not in before:
            lines.append(f"{name:<{width}}  {'-':>6}  {ratio:6.2f}  new")
            continue
        change = ratio / before[name] - 1
        if change < -TOLERANCE:
            worse.append(name)
        mark = "  WORSE" if name in worse else ""
        lines.append(f"{name:<{width}}  {before[name]:6.2f}  {ratio:6.2f}  {100 * change:+5.0f} %{mark}")
    lines += [
        f"{name:<{width}}  {ratio:6.2f}  {'-':>6}  not measured now"
        for name, ratio in before.items()
        if name not in now
    ]
    return lines, worse
