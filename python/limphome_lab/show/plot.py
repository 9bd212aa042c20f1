"""Command plot: draws the figures of a run, or of several side by side."""

import sys
from pathlib import Path

from limphome_lab import command, paths, runfolder
from limphome_lab.ending import with_exit_code


def parse_arguments():
    parser = command.parser(
        "plot",
        "Draws the figures of a run: the paper's, terms of the reward, use of actions, margin and torque over an "
        "episode. Of several runs: how learning went and the terms of the reward: every seed, medians and quartiles.",
        "runs/default-seed1-20250131-120000 --value-map boom,arm --paper",
    )
    parser.add_argument(
        "runs", metavar="RUN", nargs="+", type=runfolder.named, help="run folder; of several, folders of such, too"
    )
    parser.add_argument("--episode", type=int, help="of one run: which is drawn by its decisions; default the last")
    parser.add_argument(
        "--value-map",
        metavar="X,Y",
        help="of one run: what was learned as a map over two inputs: roll, pitch, an actuator; a planner: joints alone",
    )
    parser.add_argument("--paper", action="store_true", help="at a column's width as well, as PDF and PNG, in paper/")
    parser.add_argument("--out", metavar="DIR", help="folder for the figures; default RUN/figures, of several figures/")
    args = parser.parse_args()
    if len(args.runs) > 1 and (args.episode is not None or args.value_map is not None):
        parser.error("--episode and --value-map are of one run")
    return args


def runs_within(path):
    """Whether it is a folder of runs, or of a study, and no run itself."""
    return not (Path(path) / "config.ini").exists() and any(Path(path).glob("**/config.ini"))


def draw_one(args):
    folder = runfolder.existing(args.runs[0], "episodes", "messages", *(["policy"] if args.value_map else []))
    if not folder.read_episodes():
        raise runfolder.InputError(f"{args.runs[0]}: no episode has ended, so there is nothing to draw")
    from limphome_lab.show.figures import more  # matplotlib takes most of a second to load

    return more.draw(folder, args.out, args.episode, args.value_map, args.paper)


def draw_several(args):
    from limphome_lab.show import experiments
    from limphome_lab.show.figures import more

    runs, passed_over = experiments.find(args.runs)
    grouped, told = experiments.group(runs)
    for each in [*passed_over, *told, *(f"{each.letter}: {each.name}" for each in grouped if each.name)]:
        print(each, file=sys.stderr)
    return more.draw_side_by_side(grouped, args.out or "figures", args.paper)


@with_exit_code
def main():
    args = parse_arguments()
    several = len(args.runs) > 1 or runs_within(args.runs[0])
    for file in draw_several(args) if several else draw_one(args):
        print(paths.shown(file))
    return 0


if __name__ == "__main__":
    sys.exit(main())
