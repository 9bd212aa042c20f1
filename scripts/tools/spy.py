"""scripts/spy: the messages of a running pair, in a window (lcm-spy) or as text."""

import argparse
import os
import sys
from pathlib import Path

from tools import network, paths, registry
from tools.ending import run_script
from tools.runfolder import InputError


def parse_arguments():
    parser = argparse.ArgumentParser(
        prog="scripts/spy", description="Shows the messages of a running pair: lcm-spy with our types decoded.")
    parser.add_argument("run", metavar="RUN", nargs="?", help="run folder of the pair; default: the one started last")
    parser.add_argument("--text", action="store_true", help="in this terminal, without Java or a display")
    return parser.parse_args()


def find_pair(run):
    """Entry in the registry of the pair to watch."""
    pairs = registry.running()
    if not pairs:
        raise InputError("nothing is running; start scripts/train or scripts/launch first")
    if run is None:
        return pairs[0]
    wanted = str(Path(run).absolute())
    for pair in pairs:
        if pair["run"] == wanted:
            return pair
    listed = "\n".join(f"  {paths.shown(pair['run'])}" for pair in pairs)
    raise InputError(f"{run} is not running; these are:\n{listed}")


def main():
    args = parse_arguments()
    pair = find_pair(args.run)
    if args.text:
        command = [sys.executable, "-m", "tools.spy_text", pair["url"]]
    else:
        from tools.spy_window import window_command
        command = window_command(pair["url"])
    print(f"watching {paths.shown(pair['run'])}", file=sys.stderr, flush=True)
    command = [*network.join_prefix(pair["pid"]), *command]
    os.execvp(command[0], command)


if __name__ == "__main__":
    run_script(main)
