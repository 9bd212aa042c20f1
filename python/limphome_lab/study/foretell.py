"""What a study will cost, before it is made: one run of each case is made and measured, and thrown away.

Everything else is counted: seeds, evaluations, nodes. docs/performance.md tells how near that came.
"""

import re
import resource
import subprocess
import sys
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

from limphome_lab.ending import Ending, InputError
from limphome_lab.study.plan import Plan

# Beside what the runs themselves take, as docs/performance.md tells how it was measured:
STUDY_S = 4.0  # of a core: Snakemake starts, and the report is written
PLANNED_JOB_S = 0.009  # of the one process that makes the plan
LOCAL_JOB_S = 0.05  # of a core: Snakemake starts a job
SLURM_JOB_S = 4.0  # of a core: it submits a job, which starts a Snakemake of its own, which starts the run
SLURM_SUBMIT_S = 0.06  # of that, in the one process that submits all jobs
SLURM_STATUS_S = 40.0  # between two looks of Snakemake's at its jobs
FILES_OF_A_JOB = 3  # its log, and what Snakemake notes of it
FILES_OF_A_STUDY = 24  # report, plan and figures, and Snakemake's own


@dataclass
class Cost:
    """Of a job, or of many."""

    core_s: float = 0.0  # processor time: what a core of its own would take, whatever else this machine does
    files: int = 0  # folders, too
    bytes: int = 0
    jobs: int = 0

    def __add__(self, other):
        return Cost(*(a + b for a, b in zip(vars(self).values(), vars(other).values(), strict=True)))

    def __mul__(self, number):
        return Cost(*(number * a for a in vars(self).values()))


def machine(text):
    """(nodes, cores of each) of "64x32"."""
    match = re.fullmatch(r"([1-9]\d{0,5})x([1-9]\d{0,3})", text)
    if not match:
        raise InputError(f"--foretell {text}: must be nodes x cores of each, such as 64x32")
    return int(match[1]), int(match[2])


def jobs_at_a_time(profile):
    """What Snakemake's profile allows; None: as many as there are."""
    try:
        match = re.search(r"^jobs: *(\d+)", (Path(profile) / "config.yaml").read_text(errors="replace"), re.MULTILINE)
    except OSError as error:
        raise InputError(f"{profile}: no profile of Snakemake: {error.strerror}: config.yaml") from error
    return int(match[1]) if match else None


def measured(command, out):
    """Makes what a job makes in the folder `out`; returns its Cost."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = subprocess.run([*command, "--out", str(out)], capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if result.returncode != 0:
        raise Ending(f"a run to measure ended with exit code {result.returncode}:\n{result.stderr}")
    made = [out, *out.rglob("*")]
    core = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    size = sum(file.lstat().st_blocks * 512 for file in made)
    return Cost(core, len(made), size, 1)


def of_each_case(wanted, together):
    """[Cost of a seed, with its evaluations] by running the first seed of each case."""
    seed = next(iter(seed for seeds in wanted.seeds.values() for seed in seeds))
    plan = Plan(replace(wanted, seeds={"test": [seed]}), "/nonexistent", together)
    for number, run in enumerate(plan.runs, 1):
        print(f"measuring {run.case.name}, {number} of {len(plan.runs)}", file=sys.stderr, flush=True)
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "run"
            cost = measured(run.train, out)
            for name, (_, command) in run.evaluations.items():
                cost += measured([*command, str(out)], Path(folder) / name)
            yield cost


def total(costs, seeds):
    return sum((cost * seeds for cost in costs), Cost())


def with_start(cost, slurm):
    """Processor time of jobs, that of starting them included [s]."""
    return cost.core_s + cost.jobs * (SLURM_JOB_S if slurm else LOCAL_JOB_S)


def wall_s(cost, longest, slots, slurm):
    """How long a study takes on so many cores: no less than its longest seed, nor than to submit its jobs."""
    working = max(with_start(cost, slurm) / slots, with_start(longest, slurm))
    if slurm:
        working = max(working, cost.jobs * SLURM_SUBMIT_S) + SLURM_STATUS_S
    return working + STUDY_S + cost.jobs * PLANNED_JOB_S


def tell(wanted, text, profile, together):
    nodes, cores = machine(text)
    allowed = jobs_at_a_time(profile) if profile else None
    seeds = sum(map(len, wanted.seeds.values()))
    costs = list(of_each_case(wanted, together))
    cost = total(costs, seeds)
    slots = min(nodes * cores, allowed or nodes * cores)
    longest = max(costs, key=lambda each: each.core_s)
    print(f"runs        {len(costs) * seeds}, with evaluations {cost.jobs} jobs")
    print(f"core hours  {(with_start(cost, profile) + STUDY_S) / 3600:.3g}")
    print(f"files       {cost.files + cost.jobs * FILES_OF_A_JOB + FILES_OF_A_STUDY}")
    print(f"disk        {cost.bytes / 1e9:.3g} GB")
    print(f"wall hours  {wall_s(cost, longest, slots, profile) / 3600:.3g} on {nodes} x {cores} cores")
    if slots < nodes * cores:
        print(f"{profile}: jobs: {allowed} leaves {nodes * cores - slots} of {nodes * cores} cores idle")
