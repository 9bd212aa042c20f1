"""Command compare: experiments side by side, by the runs that were made of each with several seeds."""

import csv
import json
import sys
import textwrap
from dataclasses import asdict, dataclass

from limphome_lab import command, paths, runfolder
from limphome_lab.ending import with_exit_code
from limphome_lab.show import experiments, learned
from limphome_lab.show.summary import quartiles

WIDTH = 79  # of a line of text
NEVER = float("inf")
MEASURES = ("n", "held", "robot_minutes", "goal_share", "duration_s", "lateral_error_m", "reward", "tumbles")


@dataclass
class Seed:
    """What a run came to; those from goal_share to reward are of its last 60 episodes."""

    seed: int
    run: str
    episodes: int
    n: int | None  # learned at; None: never
    held: float | None
    robot_minutes: float | None
    goal_share: float
    duration_s: float
    lateral_error_m: float
    reward: float
    tumbles: int  # of all episodes


def measure(run, hard):
    episodes = run.episodes
    end = episodes[-learned.LAST :]
    duration, lateral = learned.last(episodes)
    return Seed(
        run.seed,
        paths.shown(run.folder.path),
        len(episodes),
        learned.learned_at(episodes, hard),
        learned.held(episodes, hard),
        learned.robot_minutes(episodes, hard),
        sum(episode.outcome == "goal" for episode in end) / len(end),
        duration,
        lateral,
        quartiles([episode.reward for episode in end])[1],
        sum(episode.outcome == "tumble" for episode in episodes),
    )


def compared(experiment, hard):
    """An experiment as JSON has it. Quartiles are over the seeds; one that never learned is above all others."""
    from limphome_lab.study import intervals  # SciPy takes a while to load

    seeds = [measure(run, hard) for run in experiment.runs]
    successes = sum(seed.n is not None for seed in seeds)
    return {
        "letter": experiment.letter,
        "differs": experiment.differs,
        "runs": len(seeds),
        "learned": successes,
        "learned_share_95": list(intervals.share(successes, len(seeds))),
        **{f"quartiles_{name}": spread([getattr(seed, name) for seed in seeds], name) for name in MEASURES},
        "seeds": [asdict(seed) for seed in seeds],
    }


def spread(values, name):
    """[lower quartile, median, upper]; None stands for never, and for what there is not."""
    if name == "n":
        ordered = sorted(NEVER if value is None else value for value in values)
        found = [_quantile(ordered, share) for share in (0.25, 0.5, 0.75)]
        return [None if value == NEVER else value for value in found]
    known = [value for value in values if value is not None]
    return list(quartiles(known)) if known else [None] * 3


def _quantile(ordered, share):
    """Interpolated, but for what is next to a seed that never learned: there it is the greater."""
    at = share * (len(ordered) - 1)
    below, above = ordered[int(at)], ordered[min(int(at) + 1, len(ordered) - 1)]
    return below if at == int(at) or below == above else below + (at - int(at)) * (above - below)


def text(found, told):
    """A table of the experiments, and one of the seeds of each."""
    lines = [*wrapped(told, "note: ")]
    if len(found) > 1:
        for each in found:
            lines += wrapped([_name(each)], f"{each['letter']}  ")
    lines += ["", f"{'':<3}{'runs':>4} {'learned':>7} {'95 %':>10} {'n':>16} {'duration [s]':>17} {'beside [m]':>17}"]
    for each in found:
        low, high = each["learned_share_95"]
        lines.append(
            f"{each['letter']:<3}{each['runs']:>4} {each['learned']:>7} {f'{low:.0%}-{high:.0%}':>10}"
            f" {_middle(each['quartiles_n'], '{:.0f}'):>16} {_middle(each['quartiles_duration_s'], '{:.3g}'):>17}"
            f" {_middle(each['quartiles_lateral_error_m'], '{:.2f}'):>17}"
        )
    lines += wrapped(
        [f"medians (quartiles) over the seeds; duration and offset are those of the last {learned.LAST} episodes"]
    )
    for each in found:
        lines += ["", f"{each['letter']:<3} seed  learned at  held  minutes  goals  duration  beside  reward  tumbles"]
        lines += [f"    {_seed_row(seed)}" for seed in each["seeds"]]
    return "\n".join(lines)


def _name(each):
    return " ".join(f"{key}={value}" for key, value in each["differs"].items())


def wrapped(texts, before=""):
    """Each with its first line behind `before`."""
    for each in texts:
        yield from textwrap.wrap(
            each, WIDTH, initial_indent=before, subsequent_indent=" " * len(before), break_on_hyphens=False
        )


def _middle(values, form):
    lower, median, upper = ("never" if value is None else form.format(value) for value in values)
    return median if lower == upper else f"{median} ({lower}-{upper})"


def _seed_row(seed):
    held, minutes = (
        "" if seed[name] is None else form.format(seed[name])
        for name, form in (("held", "{:.0%}"), ("robot_minutes", "{:.1f}"))
    )
    learned_at = "never" if seed["n"] is None else seed["n"]
    return (
        f"{seed['seed']:>4} {learned_at:>11} {held:>5} {minutes:>8} {seed['goal_share']:>6.0%}"
        f" {seed['duration_s']:>7.1f} s {seed['lateral_error_m']:>5.2f} m {seed['reward']:>7.4g} {seed['tumbles']:>8}"
    )


def write_csv(found, stream):
    """A row for each seed, with the settings that differ."""
    differing = list(found[0]["differs"])
    columns = ["experiment", *differing, *found[0]["seeds"][0]]
    writer = csv.DictWriter(stream, columns, lineterminator="\n")
    writer.writeheader()
    for each in found:
        writer.writerows({"experiment": each["letter"], **each["differs"], **seed} for seed in each["seeds"])


def draw(grouped, found, out, paper):
    """The figures, in the folder `out`; returns their files."""
    from limphome_lab.show import figures
    from limphome_lab.show.figures import courses, sides

    return figures.save({"compared": sides.draw(grouped, found), "courses": courses.draw(grouped)}, out, paper)


def parse_arguments():
    parser = command.parser(
        "compare",
        "Experiments side by side: runs that differ in their seed alone are one, and each is named after the settings "
        "in which it differs from the others.",
        "runs/default-seed* runs/paper-seed* --figures compared",
    )
    parser.add_argument(
        "runs", metavar="RUN", nargs="+", type=runfolder.named, help="run folder, folder of such, or folder of a study"
    )
    parser.add_argument(
        "--hard",
        action="store_true",
        help="learned: the limit of 9 s follows each run's own best pace, see docs/study.md",
    )
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_true", help="print JSON instead of tables")
    form.add_argument("--csv", action="store_true", help="print a row for each seed instead, as CSV")
    parser.add_argument("--figures", metavar="DIR", help="draw figures, too, into this folder")
    parser.add_argument("--paper", action="store_true", help="figures at a column's width as well, as PDF and PNG")
    args = parser.parse_args()
    if args.paper and args.figures is None:
        parser.error("--paper is about figures: give --figures DIR, too")
    return args


@with_exit_code
def main():
    args = parse_arguments()
    runs, passed_over = experiments.find(args.runs)
    grouped, told = experiments.group(runs)
    told = passed_over + told
    found = [compared(each, args.hard) for each in grouped]
    if args.json:
        print(json.dumps({"notes": told, "experiments": found}, indent=2))
    elif args.csv:
        write_csv(found, sys.stdout)
    else:
        print(text(found, told))
    if args.figures is not None:
        for file in draw(grouped, found, args.figures, args.paper):
            print(paths.shown(file), file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
