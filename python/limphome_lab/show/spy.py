"""Command spy: the messages of a running pair, in a window (lcm-spy) or as text."""

import os
import sys
from pathlib import Path

from limphome_lab import channels, command, network, paths, registry
from limphome_lab.ending import with_exit_code
from limphome_lab.runfolder import InputError

PREFIX = channels.STATE.removesuffix("STATE")


def parse_arguments():
    parser = command.parser(
        "spy", "Shows the messages of a running pair: lcm-spy with our types decoded.", "--text --channel STATUS"
    )
    parser.add_argument("run", metavar="RUN", nargs="?", help="run folder of the pair; default: the one started last")
    parser.add_argument("--text", action="store_true", help="in this terminal, without Java or a display")
    parser.add_argument(
        "--channel",
        action="append",
        default=[],
        metavar="NAME",
        help="with --text: only this one, such as STATUS; repeatable",
    )
    args = parser.parse_args()
    if args.channel and not args.text:
        parser.error("--channel is for --text; in the window a channel is opened by a click")
    args.channel = [full_name(name, parser) for name in args.channel]
    return args


def full_name(name, parser):
    """The name of the channel that a short one such as "status" stands for."""
    names = sorted(value for key, value in vars(channels).items() if key.isupper())
    found = next((each for each in names if name.upper() in (each, each.removeprefix(PREFIX))), None)
    if found is None:
        parser.error(f"--channel {name}: must be one of {', '.join(each.removeprefix(PREFIX) for each in names)}")
    return found


def find_pair(run):
    """Entry in the registry of the pair to watch."""
    pairs = registry.running()
    if not pairs:
        raise InputError(f"nothing is running; start {command.called('train')} or {command.called('launch')} first")
    if run is None:
        return pairs[0]
    wanted = str(Path(run).absolute())
    for pair in pairs:
        if pair["run"] == wanted:
            return pair
    listed = "\n".join(f"  {paths.shown(pair['run'])}" for pair in pairs)
    raise InputError(f"{run} is not running; these are:\n{listed}")


@with_exit_code
def main():
    args = parse_arguments()
    pair = find_pair(args.run)
    inside = network.join_prefix(pair["pid"])
    if args.text:
        words = [sys.executable, "-m", "limphome_lab.show.spy_text", pair["url"], *args.channel]
    else:
        from limphome_lab.show.spy_window import window_command

        words = window_command(pair["url"], inside)
    print(f"watching {paths.shown(pair['run'])}", file=sys.stderr, flush=True)
    words = [*inside, *words]
    os.execvp(words[0], words)


if __name__ == "__main__":
    sys.exit(main())
