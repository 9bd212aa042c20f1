"""Command view: a page in the browser that shows the robot of a running pair, live."""

import argparse
import os
import sys

from limphome_lab import command, runfolder
from limphome_lab.ending import with_exit_code
from limphome_lab.run.processes import raise_on_signals

NICE = 5  # the run comes first


def parse_arguments():
    parser = command.parser(
        "view",
        "Shows the robot of a running pair in the browser, live; joins and leaves at will.",
        "runs/default-seed1-20250131-120000",
    )
    parser.add_argument("run", metavar="RUN", nargs="?", help="run folder of the pair; default: whichever is running")
    parser.add_argument("--port", type=int, default=0, help="of the page; default: a free one")
    # of one that was started with its page: the process whose pair alone it shows, and after which it ends
    parser.add_argument("--pid", type=int, help=argparse.SUPPRESS)
    parser.add_argument("--joins", type=int, help=argparse.SUPPRESS)  # descriptor to tell on that it listens
    return parser.parse_args()


@with_exit_code
def main():
    args = parse_arguments()
    raise_on_signals()
    from limphome_lab.view import live  # viser takes a second to load

    os.nice(NICE)
    run = None if args.run is None else runfolder.existing(args.run).path
    live.serve(run, args.port, args.pid, args.joins, lambda url: print(f"open {url}\nCtrl-C ends it", flush=True))
    return 0


if __name__ == "__main__":
    sys.exit(main())
