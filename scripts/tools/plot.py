"""scripts/plot: draws the figures of a run."""

import argparse

from tools import paths, runfolder
from tools.ending import run_script


def main():
    parser = argparse.ArgumentParser(prog="scripts/plot", description="Draws the figures of a run.")
    parser.add_argument("run", metavar="RUN", help="run folder")
    args = parser.parse_args()
    folder = runfolder.existing(args.run, "episodes", "messages")
    if not folder.read_episodes():
        raise runfolder.InputError(f"{args.run}: no episode has ended, so there is nothing to draw")
    from tools.figures import draw_all  # matplotlib takes most of a second to load
    for file in draw_all(folder):
        print(paths.shown(file))
    return 0


if __name__ == "__main__":
    run_script(main)
