"""Command bench: measures speed, each figure against a baseline measured in the same run."""

import json
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import asdict, dataclass
from pathlib import Path

from limphome_lab import command, network, paths, runfolder
from limphome_lab.ending import Ending, with_exit_code
from limphome_lab.measure import against

PROGRAMS = paths.BUILD / "bench"
ROUNDS = 5  # all that is compared with each other is measured in turn, this often
SMOKE = paths.CONFIG / "smoke.ini"

BUILDS = {
    "": "-O2",
    "_native": "-O3 -march=native",
}  # of bench_decision and bench_planner, by the end of a figure's name

# Ways of bench_decision that are compared with the library's.
RIVALS = {"plain_single": "plain C loop, float", "plain_double": "plain C loop, double", "eigen": "Eigen's matrix form"}
LEAST_AGREEMENT = 0.98  # share of equal actions; rounding may turn one, and with it those that follow


class BenchFailed(Ending):
    """A program failed; the text tells which."""


@dataclass
class Figure:
    name: str
    value: float
    unit: str
    baseline: float  # in the same unit
    ratio: float  # above 1: better than the baseline
    what: str  # for people

    def as_dict(self):
        figure = asdict(self)
        del figure["what"]
        return figure


def lower_is_better(name, value, unit, baseline, what):
    return Figure(name, value, unit, baseline, baseline / value, what)


def run(program, *arguments):
    """What PROGRAMS/program prints."""
    result = subprocess.run([PROGRAMS / program, *map(str, arguments)], capture_output=True, text=True)
    if result.returncode != 0:
        raise BenchFailed(f"{program}: exit code {result.returncode}\n{result.stderr}")
    return result.stdout


def decision_times(program):
    """Seconds per decision of each way."""
    seconds = {}
    for line in run(program).splitlines():
        way, measured, agreement = line.split()
        if float(agreement) < LEAST_AGREEMENT:
            raise BenchFailed(f"{program}: {way} takes other decisions than the library ({agreement})")
        seconds[way] = float(measured)
    return seconds


def decision():
    """Q of all actions, selection and update, in the library and in other ways."""
    from limphome_lab.measure import bench_numpy  # NumPy is there once all is set up, and --help before

    measured = {suffix: [] for suffix in BUILDS}
    by_numpy = []
    for _ in range(ROUNDS):
        for suffix in BUILDS:
            measured[suffix].append(decision_times(f"bench_decision_{suffix.lstrip('_') or 'O2'}"))
        by_numpy.append(bench_numpy.seconds_per_decision())

    for suffix, flags in BUILDS.items():
        median = {way: statistics.median(each[way] for each in measured[suffix]) for way in measured[suffix][0]}
        ours = median["limphome"]
        for way, text in RIVALS.items():
            name = f"decision{suffix}" + ("" if way == "plain_single" else f"_{way}")
            yield lower_is_better(name, ours, "s", median[way], f"one decision, {flags}, against {text}")
        if not suffix:
            yield lower_is_better(
                "decision_numpy", ours, "s", statistics.median(by_numpy), f"one decision, {flags}, against NumPy"
            )
        yield lower_is_better(
            f"decision_two_arm{suffix}",
            median["limphome_two_arm"],
            "s",
            27 * ours,
            f"2187 joint actions, {flags}, against 27 times 81",
        )


def planner_decision():
    """What a step did taken in, ten postures backed up, two steps looked ahead: in the library and in plain loops."""
    for suffix, flags in BUILDS.items():
        seconds = decision_times(f"bench_planner_{suffix.lstrip('_') or 'O2'}")
        for way in ("plain_single", "plain_double"):
            name = f"decision_planner{suffix}" + ("" if way == "plain_single" else f"_{way}")
            text = f"a planner's decision, {flags}, against {RIVALS[way]}"
            yield lower_is_better(name, seconds["limphome"], "s", seconds[way], text)


def simulator_step():
    """Of the simulator as it is, and beside other engines."""
    from limphome_lab.measure import bench_simulator  # as bench_numpy above

    factor = statistics.median(bench_simulator.real_time_factor() for _ in range(ROUNDS))
    rate = factor / bench_simulator.OUR_STEP
    yield Figure("simulator_step", rate, "1/s", rate / factor, factor, "time steps of the world, against real time")
    yield from (Figure(**figure) for figure in bench_simulator.measure())


def lockstep_round_trip(url):
    trips = {"udpm": [], "liblcm": []}
    for _ in range(ROUNDS):
        for line in run("bench_round_trip", url).splitlines():
            bus, median, _ = line.split()
            trips[bus].append(float(median))
    ours, bare = map(statistics.median, trips.values())
    yield lower_is_better("lockstep_round_trip", ours, "s", bare, "state out, command back, against liblcm")


def training_run():
    """Simulated against wall time of a whole scripts/train, all it does at its beginning and end included."""
    factors = []
    for _ in range(2):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "run"
            start = time.monotonic()
            result = subprocess.run(
                [sys.executable, "-m", "limphome_lab.run.train", "--config", SMOKE, "--out", out, "--quiet"],
                capture_output=True,
                text=True,
            )
            wall = time.monotonic() - start
            if result.returncode != 0:
                raise BenchFailed(f"train: exit code {result.returncode}\n{result.stderr}")
            simulated = sum(episode.duration_s for episode in runfolder.RunFolder(out).read_episodes())
        factors.append(simulated / wall)
    factor = statistics.median(factors)
    yield Figure(
        "training_run", factor, "s/s", 1.0, factor, "config/smoke.ini from start to figures, against real time"
    )


def table(figures):
    rows = [
        (f.name, f"{f.value:.3g} {f.unit}", f"{f.baseline:.3g} {f.unit}", f"{f.ratio:.1f}", f.what) for f in figures
    ]
    rows.insert(0, ("name", "value", "baseline", "ratio", "what"))
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return "\n".join(
        "  ".join(
            cell.rjust(width) if 0 < i < 4 else cell.ljust(width)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    )


def parse_arguments():
    parser = command.parser(
        "bench", "Measures speed, each figure against a baseline of the same run.", "--json bench.json"
    )
    parser.add_argument(
        "--json", metavar="FILE", type=command.file_to_write, help="write name, value, unit, baseline and ratio of each"
    )
    parser.add_argument(
        "--against",
        metavar="FILE",
        type=Path,
        help=f"what an earlier --json wrote; exit code 1 if a ratio fell by more than {100 * against.TOLERANCE:.0f} %%",
    )
    parser.add_argument("--network", choices=("private", "host"), default="private", help="as for train")
    return parser.parse_args()


@with_exit_code
def main():
    args = parse_arguments()
    before = against.read(args.against) if args.against else {}
    url = network.enter(args.network)
    figures = []
    for name, measure in {
        "decision": decision,
        "decision_planner": planner_decision,
        "simulator_step": simulator_step,
        "lockstep_round_trip": lambda: lockstep_round_trip(url),
        "training_run": training_run,
    }.items():
        print(f"measuring {name}", file=sys.stderr, flush=True)
        figures.extend(measure())
    print(table(figures))
    if args.json:
        args.json.write_text(json.dumps([figure.as_dict() for figure in figures], indent=2) + "\n")
    return tell_change(before, figures) if before else 0


def tell_change(before, figures):
    """Exit code."""
    lines, worse = against.compare(before, {figure.name: figure.ratio for figure in figures})
    print("", *lines, sep="\n")
    if worse:
        print(f"worse by more than {100 * against.TOLERANCE:.0f} %: {', '.join(worse)}", file=sys.stderr)
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
