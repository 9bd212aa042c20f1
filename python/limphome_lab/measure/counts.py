"""Command counts: instructions of a decision and of a simulated step, against those recorded in test/counts.txt.

Times differ from machine to machine and from minute to minute, counts of instructions do not. On this processor
Valgrind counts them, in a long run less a short one; on emulated boards test/embedded/count.c does.
"""

import re
import shutil
import subprocess
import sys
from pathlib import Path

from limphome_lab import command, files, paths
from limphome_lab.ending import Ending, InputError, with_exit_code

RECORD = paths.ROOT / "test" / "counts.txt"
TOLERANCE = 0.03  # share more than recorded, of the same compiler; test/embedded/count.c has the same
OTHER_COMPILER = 0.15  # compilers and their versions differ by as much

HEAD = """\
# Instructions, written by `scripts/counts --record`: of a decision, at the mean of the first of a run in which it
# learns, and of a step of 5 ms of the simulator on level and on rough ground. x86: by the compiler named, counted by
# Valgrind; m4f (-O2) and m7_small (-Os): on the boards of test/embedded.
"""
STEP_S = 0.005  # default of simulator.time_step_s
SHORT_S, LONG_S = 0.5, 1.5  # simulated
DRIVE = "command 0 0.3 0.1 0.1 -0.1"  # the sound crawler drives, the arm moves
BOARDS = {"cortex-m4f.Release": "m4f", "cortex-m7.MinSizeRel": "m7_small"}
SAID_BY_BOARD = re.compile(r"(q_learning|planner)\n.* least: .*\n.* mean: +(\d+)\n")  # test/embedded/count.c


def compiler():
    """Of the C in the build, e.g. "GNU 12.2.0"."""
    made = next(iter(sorted(paths.BUILD.glob("CMakeFiles/*/CMakeCCompiler.cmake"))), None)
    if made is None:
        raise Ending(f"{paths.BUILD}: no build by CMake")
    said = dict(re.findall(r'set\(CMAKE_C_COMPILER_(ID|VERSION) "([^"]*)"\)', made.read_text()))
    return f"{said['ID']} {said['VERSION']}"


def valgrind(words, given=""):
    """Instructions of a whole process that gets this on stdin."""
    if shutil.which("valgrind") is None:
        raise Ending("Valgrind is missing, which counts instructions: apt-get install valgrind")
    counting = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
    result = subprocess.run([*counting, *map(str, words)], input=given, capture_output=True, text=True)
    counted = re.search(r"Collected : (\d+)", result.stderr)
    if result.returncode != 0 or counted is None:
        raise Ending(f"{Path(words[0]).name} under Valgrind: exit code {result.returncode}\n{result.stderr}")
    return int(counted[1])


def decisions(of_q_learning, of_planner):
    """Of the library by -O2 (test/limphome/decisions.c)."""
    return valgrind([paths.BUILD / "bin" / "decisions_O2", of_q_learning, of_planner])


def simulated(seconds, settings):
    words = [paths.program("instrument"), "--config", paths.CONFIG / "paper.ini"]
    words += ["--robot", paths.CONFIG / "crawler.urdf"]
    for setting in ("failure.actuator=left_crawler", "failure.mode=locked", *settings):
        words += ["--set", setting]
    return valgrind(words, f"{DRIVE}\nadvance {seconds}\n")


def step(*settings):
    return round((simulated(LONG_S, settings) - simulated(SHORT_S, settings)) / ((LONG_S - SHORT_S) / STEP_S))


COUNTED = {
    "decision_q_learning_x86": lambda: round((decisions(300, 0) - decisions(100, 0)) / 200),
    "decision_planner_x86": lambda: round((decisions(0, 11) - decisions(0, 1)) / 10),
    "step_level_x86": step,
    "step_rough_x86": lambda: step("ground.rough_amplitude_m=0.08", "ground.rough_wavelength_m=1"),
}


def boards():
    """{name: count} by the tests of the emulated boards, which take minutes; empty where they are skipped."""
    counts = {}
    for board, short in BOARDS.items():
        print(f"counting on {board}, some minutes", file=sys.stderr, flush=True)
        words = ["ctest", "--test-dir", paths.BUILD, "--verbose", "-R", f"^embedded.{board}$"]
        result = subprocess.run([*map(str, words)], capture_output=True, text=True)
        said = SAID_BY_BOARD.findall(result.stdout)
        for learner, mean in said:
            counts[f"decision_{learner}_{short}"] = int(mean)
        if not said:
            print(f"{board}: nothing was counted; what was recorded stays", file=sys.stderr)
    return counts


def read(path=RECORD):
    """What was recorded: {name: count}, and the compiler."""
    recorded, made_by = {}, None
    for number, line in enumerate(path.read_text().splitlines(), 1):
        name, _, value = line.partition(" ")
        if name == "compiler":
            made_by = value
        elif line and not line.startswith("#"):
            if not value.isdecimal() or int(value) == 0:
                raise InputError(f"{path}:{number}: {line!r} must be a name and a number of instructions")
            recorded[name] = int(value)
    return recorded, made_by


def record(counts, path=RECORD):
    """Puts `counts` in the place of what was recorded of them."""
    recorded = (read(path)[0] if path.exists() else {}) | counts
    lines = [f"compiler {compiler()}", *(f"{name} {recorded[name]}" for name in sorted(recorded))]
    files.replace(path, HEAD + "\n".join(lines) + "\n")


def tolerance(made_by):
    return TOLERANCE if made_by == compiler() else OTHER_COMPILER


def compare(counts, recorded, allowed):
    """Lines for people, and the names of those that take more than is allowed."""
    more = [name for name, count in counts.items() if count > (1 + allowed) * recorded.get(name, count)]
    lines = [f"{'name':<26}  recorded       now  change"]
    for name, count in counts.items():
        before = recorded.get(name)
        change = f"{100 * (count / before - 1):+6.1f} %" if before else "new"
        lines.append(f"{name:<26}  {before or '-':>8}  {count:>8}  {change}{'  MORE' if name in more else ''}")
    return lines, more


def advice(allowed, made_by):
    if allowed == TOLERANCE:
        return "If it is what the change costs, scripts/counts --record takes it down, and the change says why."
    return f"Recorded by {made_by}, this is {compiler()}: to know, record at the revision before with this compiler."


@with_exit_code
def main():
    parser = command.parser(
        "counts",
        "Counts instructions of decision and simulated step; exit code 1 where they are more than recorded.",
        "--record",
    )
    parser.add_argument("--record", action="store_true", help="write test/counts.txt anew, the boards' too: minutes")
    args = parser.parse_args()
    counts = {}
    for name, count in COUNTED.items():
        print(f"counting {name}", file=sys.stderr, flush=True)
        counts[name] = count()
    if args.record:
        record(counts | boards())
        print(paths.shown(RECORD))
        return 0
    recorded, made_by = read()
    allowed = tolerance(made_by)
    lines, more = compare(counts, recorded, allowed)
    print(*lines, sep="\n")
    if more:
        print(f"more than {100 * allowed:.0f} % above what was recorded. {advice(allowed, made_by)}", file=sys.stderr)
    return 1 if more else 0


if __name__ == "__main__":
    sys.exit(main())
