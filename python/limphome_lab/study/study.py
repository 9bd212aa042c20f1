"""Command study: makes the runs of a table side by side, and a report of them."""

import contextlib
import fcntl
import importlib
import importlib.util
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from limphome_lab import command, paths
from limphome_lab.ending import Ending, with_exit_code
from limphome_lab.run.processes import Child, raise_on_signals
from limphome_lab.runfolder import InputError
from limphome_lab.show.progress import LINE_EVERY_S, clock
from limphome_lab.study import foretell, table
from limphome_lab.study.plan import Plan

SNAKEFILE = Path(__file__).with_name("Snakefile")
REPORT = "limphome_lab.study.report"
POLL_S = 0.5
GRACE_S = 60.0  # for runs to end cleanly after Ctrl-C, before they are killed; a cluster takes half a minute


def parse_arguments():
    parser = command.parser(
        "study",
        "Makes the runs of a table side by side and writes report.md and report.html. Called again it goes on.",
        "config/studies/smoke.toml",
    )
    parser.add_argument("table", metavar="TABLE", help="what is to be run (TOML), see docs/study.md")
    parser.add_argument("--out", metavar="DIR", help="the study's folder; default studies/<table's name>")
    parser.add_argument("--cores", type=int, metavar="N", help="runs at a time; default: as many as there are cores")
    parser.add_argument("--profile", metavar="DIR", help="Snakemake's profile of a cluster, such as config/slurm")
    parser.add_argument(
        "--two-processes",
        action="store_true",
        help="each run on a network of its own, where spy and view can watch; default: one process, which is faster",
    )
    parser.add_argument("--dry-run", action="store_true", help="tell what would be run")
    parser.add_argument(
        "--foretell",
        metavar="NODESxCORES",
        help="tell what it would cost on so many nodes of so many cores, by a run of each case that is thrown away",
    )
    args = parser.parse_args()
    if args.cores is not None and args.cores < 1:
        parser.error(f"--cores {args.cores}: must be at least 1")
    return args


def lock(folder):
    """Holds the folder until this process ends, however it ends; the file returned must stay open."""
    file = open(folder / ".lock", "w")  # noqa: SIM115
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        raise Ending(f"{paths.shown(folder)}: this study is under way already") from error
    return file


def snakemake(args, out):
    """Words that start Snakemake. What is done is told by the folders that are there, and by nothing else."""
    # without a cluster: where Slurm is installed its plugin waits 8 s at each start for one that is not there
    words = [] if args.profile else ["env", "SLURM_CONF=/dev/null"]
    words += [sys.executable, "-m", "snakemake", "--snakefile", SNAKEFILE, "--directory", out]
    words += ["--keep-going", "--ignore-incomplete", "--nolock", "--rerun-triggers", "input"]
    words += ["--scheduler", "greedy"]  # each takes one core: there is nothing for an integer program to solve
    words += ["--cores", str(args.cores or len(os.sched_getaffinity(0)))]
    if args.profile:
        words += ["--profile", Path(args.profile).absolute()]
    return words


class Line:
    """How far the study has come: a live line on a terminal, else a line now and then."""

    def __init__(self, folders):
        self.folders = folders
        self.before = self.done()
        self.began = time.monotonic()
        self.live = sys.stderr.isatty()
        self.shown_at = self.began

    def done(self):
        return sum(folder.exists() for folder in self.folders)

    def update(self, last=False):
        now = time.monotonic()
        if last or now - self.shown_at >= (POLL_S if self.live else LINE_EVERY_S):
            self.shown_at = now
            end = "\n" if last or not self.live else ""
            sys.stderr.write(("\r" if self.live else "") + self.text(now) + end)
            sys.stderr.flush()

    def text(self, now):
        done = self.done()
        text = f"{done}/{len(self.folders)} runs and evaluations, {clock(now - self.began)}"
        if self.before < done < len(self.folders):
            text += f", {clock((len(self.folders) - done) * (now - self.began) / (done - self.before))} left"
        return f"{text:<60}" if self.live else text


def make_runs(args, plan):
    """Lets Snakemake make what is missing; returns whether all is there then."""
    log = plan.out / "snakemake.log"
    log.unlink(missing_ok=True)
    line = Line(list(plan.folders()))
    child = Child("snakemake", [str(word) for word in snakemake(args, plan.out)], log)
    try:
        importlib.import_module(REPORT)  # SciPy and matplotlib take as long to load as Snakemake takes to begin
        while child.exit_code() is None:
            line.update()
            with contextlib.suppress(subprocess.TimeoutExpired):
                child.process.wait(POLL_S)
    finally:
        end_group(child)
        line.update(last=True)
    if child.exit_code() != 0:
        print(f"Snakemake: the end of {paths.shown(log)}:\n{child.log_tail()}", file=sys.stderr)
    return child.exit_code() == 0


def end_group(child):
    """Ends Snakemake with all the runs it has started, by the signal of Ctrl-C, which makes it cancel a cluster's jobs
    too. They share a process group, which Child made."""
    for signum in (signal.SIGINT, signal.SIGKILL):
        deadline = time.monotonic() + GRACE_S
        while time.monotonic() < deadline:
            try:
                os.killpg(child.process.pid, signum)
            except ProcessLookupError:
                return
            child.exit_code()  # takes note of its end
            signum = 0  # once; from then on only whether any of them is left
            time.sleep(POLL_S)


def tell_plan(plan):
    for folder in plan.folders():
        print(f"{'done' if folder.exists() else 'to do'}  {folder.relative_to(plan.out)}")


@with_exit_code
def main():
    args = parse_arguments()
    raise_on_signals()
    wanted = table.read(args.table)
    if args.foretell is not None:
        foretell.tell(wanted, args.foretell, args.profile, together=not args.two_processes)
        return 0
    plan = Plan(wanted, args.out or paths.STUDIES / wanted.name, together=not args.two_processes)
    if args.dry_run:
        tell_plan(plan)
        return 0
    if importlib.util.find_spec("snakemake") is None:
        raise Ending("Snakemake is missing: pip install 'limphome-lab[study]'")
    try:
        plan.out.mkdir(parents=True, exist_ok=True)
        held = lock(plan.out)
    except OSError as error:
        raise InputError(f"{plan.out}: cannot be made the study's folder: {error.strerror}") from error
    plan.write()
    complete = make_runs(args, plan)
    for file in importlib.import_module(REPORT).write_report(plan):
        print(paths.shown(file))
    held.close()
    return 0 if complete else 1


if __name__ == "__main__":
    sys.exit(main())
