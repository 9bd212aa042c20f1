"""Command replay: recorded episodes in the browser, or as a video."""

import sys
from pathlib import Path

from limphome_lab import command, runfolder
from limphome_lab.ending import InputError, with_exit_code

SIZE = "640x360"
MOST_PIXELS = 4096  # along an edge of a picture


def parse_arguments():
    parser = command.parser(
        "replay",
        "Plays recorded episodes in the browser, those of several runs side by side; or draws them as a video.",
        "runs/default-seed1-20250131-120000 --episode 20 --video home.gif",
    )
    parser.add_argument("run", metavar="RUN", nargs="+", help="run folder")
    parser.add_argument("--episode", metavar="N", type=int, help="default: the last that ended")
    parser.add_argument("--speed", metavar="X", type=float, default=1.0, help="plant time to wall time; default: 1")
    parser.add_argument("--port", type=int, default=0, help="of the page; default: a free one")
    parser.add_argument("--video", metavar="FILE", type=Path, help="draw FILE, .mp4 or .gif, in place of the page")
    parser.add_argument(
        "--angle",
        metavar="NAME[,NAME]",
        default="corner",
        help="of the video: corner, side, front, behind, above, follow; of several, a picture each; default: corner",
    )
    parser.add_argument("--size", metavar="WxH", default=SIZE, help=f"of each picture of the video; default: {SIZE}")
    return parser.parse_args()


@with_exit_code
def main():
    args = parse_arguments()
    if not 0.01 <= args.speed <= 100:
        raise InputError(f"--speed {args.speed:g}: must be from 0.01 to 100")
    folders = [runfolder.existing(run, "messages") for run in args.run]
    from limphome_lab.run.processes import raise_on_signals

    raise_on_signals()
    if args.video is not None:
        return draw(args, folders)
    from limphome_lab.view.player import Player  # viser takes a second to load
    from limphome_lab.view.server import Page

    page = Page("limphome", args.port)
    try:
        player = Player(page, folders, args.episode, args.speed)
        print(f"open {page.url}\nCtrl-C ends it", flush=True)
        player.watch()
    finally:
        page.stop()


def draw(args, folders):
    """The video."""
    from limphome_lab.view import video

    video.write(folders, args.episode, args.video, angles(args.angle), size(args.size), args.speed)
    print(args.video)
    return 0


def angles(text):
    """Names of angles.ANGLES, separated by commas."""
    from limphome_lab.view.angles import ANGLES

    names = text.split(",")
    for name in names:
        if name not in ANGLES:
            raise InputError(f"--angle {name!r}: must be one of {', '.join(ANGLES)}")
    return names


def size(text):
    """(width, height), both even, as H.264 wants them."""
    words = text.split("x")
    if len(words) == 2 and all(word.isdecimal() for word in words):
        width, height = map(int, words)
        if all(16 <= edge <= MOST_PIXELS and edge % 2 == 0 for edge in (width, height)):
            return width, height
    raise InputError(f"--size {text!r}: must be WIDTHxHEIGHT, both even and from 16 to {MOST_PIXELS}")


if __name__ == "__main__":
    sys.exit(main())
