"""scripts/plot: draws the figures of a run."""

import argparse
import sys

from tools import paths, runfolder


def main():
    parser = argparse.ArgumentParser(prog="scripts/plot", description="Draws the figures of a run.")
    parser.add_argument("run", metavar="RUN", help="run folder")
    args = parser.parse_args()
    try:
        folder = runfolder.existing(args.run, "episodes", "messages")
        if not folder.read_episodes():
            raise runfolder.InputError(f"{args.run}: no episode has ended, so there is nothing to draw")
    except runfolder.InputError as error:
        print(error, file=sys.stderr)
        return 2
    from tools.figures import draw_all  # matplotlib takes most of a second to load
    for file in draw_all(folder):
        print(paths.shown(file))
    return 0


if __name__ == "__main__":
    sys.exit(main())
