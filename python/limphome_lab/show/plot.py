"""Command plot: draws the figures of a run."""

import sys

from limphome_lab import command, paths, runfolder
from limphome_lab.ending import with_exit_code


@with_exit_code
def main():
    parser = command.parser("plot", "Draws the figures of a run.", "runs/default-seed1-20250131-120000")
    parser.add_argument("run", metavar="RUN", help="run folder")
    args = parser.parse_args()
    folder = runfolder.existing(args.run, "episodes", "messages")
    if not folder.read_episodes():
        raise runfolder.InputError(f"{args.run}: no episode has ended, so there is nothing to draw")
    from limphome_lab.show.figures import draw_all  # matplotlib takes most of a second to load

    for file in draw_all(folder):
        print(paths.shown(file))
    return 0


if __name__ == "__main__":
    sys.exit(main())
