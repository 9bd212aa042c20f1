"""Mutation test of liblimphome: changes one operator or number at a time and runs the Check tests.

Each job has a folder of its own with a copy of the sources, in which ninja compiles what a change concerns. The tests
are linked with the library as a shared one, so that a changed source needs no new test programs.
"""

import argparse
import collections
import concurrent.futures
import os
import pathlib
import queue
import random
import re
import shutil
import subprocess
import sys
import time

from limphome_lab.paths import ROOT

CHANGES = [
    (r" \+ ", " - "), (r" - ", " + "), (r" \* ", " / "), (r" / ", " * "),
    (r" < ", " <= "), (r" <= ", " < "), (r" > ", " >= "), (r" >= ", " > "),
    (r" == ", " != "), (r" != ", " == "), (r" && ", " || "), (r" \|\| ", " && "),
    (r"\+= ", "-= "), (r"\b0\.5f", "0.6f"), (r"\b1\.0f", "1.1f"), (r"\b0\.0f", "0.1f"), (r"= true;", "= false;"),
]  # fmt: skip
LIBRARY = ROOT / "controller/limphome"
SMALL = {"test_capacity": "-DLH_MAX_ACTIONS=81 -DLH_MAX_PLANNED=4"}  # tests of a library with other capacities
OUTCOMES = ["noticed", "too slow", "not compiled", "same code", "SURVIVED"]
RULES = """
rule compile
  command = gcc -std=c11 -O1 -w -fPIC -ffp-contract=off -D_DEFAULT_SOURCE -I. -Itest $more -MMD -MF $out.d -c $in $
      -o $out
  deps = gcc
  depfile = $out.d
rule library
  command = gcc -shared -Wl,-Bsymbolic,-soname,library.so $in -o $out
rule program
  command = gcc $in $library -Wl,-rpath,'$$ORIGIN' -lcheck -lsubunit -lrt -lpthread -lm -o $out
"""


Mutant = collections.namedtuple("Mutant", "file number column line")  # number and column from 0; the line as changed


def mutants():
    """Each possible change of sources and headers, comments and preprocessor lines left out."""
    for file in sorted(LIBRARY.rglob("*.[ch]")):
        text = file.read_text()
        blank = re.sub(r"/\*.*?\*/", lambda comment: re.sub(r"[^\n]", "\0", comment[0]), text, flags=re.DOTALL)
        for number, (line, code) in enumerate(zip(text.splitlines(), blank.splitlines(), strict=True)):
            if not line.startswith("#"):
                for old, new in CHANGES:
                    for match in re.finditer(old, code):
                        changed = line[: match.start()] + new + line[match.end() :]
                        yield Mutant(str(file.relative_to(LIBRARY)), number, match.start(), changed)


def stem_below(file, folder):
    """Path below `folder`, without the ending."""
    return str(file.relative_to(folder).with_suffix(""))


def build_folder(more):
    return "build" + more.replace(" ", "")


def build_rules(sources, tests):
    """What ninja must know: the library from its sources and its tests {name: source} with default capacities, and
    those of SMALL. Sources are named by path without the ending."""
    text = RULES
    for more in ["", *SMALL.values()]:
        folder = build_folder(more)
        for stem in [*sources, "test/crawler", "test/runner"]:
            text += f"build {folder}/{stem}.o: compile {stem}.c\n  more = {more}\n"
        text += f"build {folder}/library.so: library {' '.join(f'{folder}/{s}.o' for s in sources)}\n"
        common = f"{folder}/test/crawler.o {folder}/test/runner.o || {folder}/library.so"
        for test, stem in tests.items():
            if SMALL.get(test, "") == more:
                text += f"build {folder}/{stem}.o: compile {stem}.c\n  more = {more}\n"
                text += f"build {folder}/{test}: program {folder}/{stem}.o {common}\n  library = {folder}/library.so\n"
    return text


class Job:
    """A folder in which one mutant at a time is compiled and tested."""

    def __init__(self, folder, limits):
        self.folder, self.limits, self.changed = folder, limits, None
        self.libraries = [library.read_bytes() for library in sorted(folder.glob("build*/library.so"))]

    def run(self, test):
        """Outcome of one test program, None if it passes."""
        program = f"{build_folder(SMALL.get(test, ''))}/{test}"
        silent = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        if subprocess.run(["ninja", "-C", self.folder, program], **silent).returncode:
            return "not compiled"
        try:
            run = subprocess.run([self.folder / program], **silent, timeout=self.limits[test])
        except subprocess.TimeoutExpired:
            return "too slow"
        return "noticed" if run.returncode else None

    def outcome(self, mutant):
        """The test named like the file comes first, as the likeliest to notice, then the others, the fastest first."""
        if self.changed is not None:
            shutil.copyfile(LIBRARY / self.changed, self.folder / "limphome" / self.changed)
        self.changed = mutant.file
        file = self.folder / "limphome" / mutant.file
        lines = file.read_text().splitlines()
        lines[mutant.number] = mutant.line
        file.write_text("\n".join(lines) + "\n")
        own = f"test_{file.stem}"
        for test in sorted(self.limits, key=lambda test: (test != own, self.limits[test])):
            if (outcome := self.run(test)) is not None:
                return outcome
        same = [library.read_bytes() for library in sorted(self.folder.glob("build*/library.so"))] == self.libraries
        return "same code" if same else "SURVIVED"


def make_jobs(work, count):
    """Builds and times the unchanged library in one folder, and copies it for the others."""
    shutil.rmtree(work, ignore_errors=True)
    first = work / "job1"
    shutil.copytree(LIBRARY, first / "limphome")
    shutil.copytree(ROOT / "test/limphome", first / "test")
    tests = {test.stem: stem_below(test, first) for test in sorted((first / "test").rglob("test_*.c"))}
    sources = [stem_below(source, first) for source in sorted((first / "limphome").rglob("*.c"))]
    (first / "build.ninja").write_text(build_rules(sources, tests))
    subprocess.run(["ninja", "-C", first, "-j", str(count)], check=True, stdout=subprocess.DEVNULL)
    limits = dict.fromkeys(tests, 600.0)
    job = Job(first, limits)
    for test in tests:
        begin = time.monotonic()
        if (failed := job.run(test)) is not None:
            raise SystemExit(f"the unchanged library: {test} {failed}")
        limits[test] = 5.0 + 10.0 * (time.monotonic() - begin)  # [s], so that a busy machine is no reason to stop
    for k in range(2, count + 1):
        shutil.copytree(first, work / f"job{k}")
    return [job, *(Job(work / f"job{k}", limits) for k in range(2, count + 1))]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--number", default="60", help="mutants to try, or all")
    parser.add_argument("--seed", type=int, default=1, help="of their choice")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="mutants at a time")
    parser.add_argument("--work", type=pathlib.Path, required=True, help="folder to work in")
    args = parser.parse_args()
    everything = list(mutants())
    number = 0 if args.number == "all" else int(args.number)
    chosen = sorted(random.Random(args.seed).sample(everything, min(number, len(everything)))) if number else everything

    jobs = queue.SimpleQueue()
    for job in make_jobs(args.work.resolve(), args.jobs):
        jobs.put(job)

    def try_one(mutant):
        job = jobs.get()
        try:
            return job.outcome(mutant)
        finally:
            jobs.put(job)

    counts = collections.defaultdict(collections.Counter)
    begin = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        for done, (mutant, outcome) in enumerate(zip(chosen, pool.map(try_one, chosen), strict=True), 1):
            counts[mutant.file][outcome] += 1
            if outcome in ("SURVIVED", "same code", "too slow"):
                place = f"{mutant.file}:{mutant.number + 1}:{mutant.column + 1}"
                print(f"{outcome:10} {place}: {mutant.line.strip()}", flush=True)
            if done % 20 == 0:
                left = (time.monotonic() - begin) / done * (len(chosen) - done)
                print(f"{done} of {len(chosen)} mutants, about {left / 60:.0f} min left", file=sys.stderr, flush=True)
    print("".join(f"{title:>14}" for title in ["mutants", *OUTCOMES]))
    for file, count in [*counts.items(), ("all", sum(counts.values(), collections.Counter()))]:
        print("".join(f"{n:14}" for n in [count.total(), *(count[outcome] for outcome in OUTCOMES)]) + f"  {file}")
    print(f"{len(chosen)} of {len(everything)} mutants, {time.monotonic() - begin:.0f} s with {args.jobs} jobs")


if __name__ == "__main__":
    main()
