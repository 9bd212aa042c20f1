"""Command growth: measures how costs grow, and draws it: of a simulated step over joints, contacts and ground, of a
decision over units, actions, measurements and postures, of a run over its episodes, of a study over runs and cores."""

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from limphome_lab import command, network, paths
from limphome_lab.ending import Ending, with_exit_code

ROUNDS = 5
GROUNDS = {  # settings of each
    "level": (),
    "incline": ("ground.incline_along_rad=0.14",),
    "steps": ("ground.step_height_m=0.05",),
    "patches": ("ground.patch_share=0.3",),
    "rough": ("ground.rough_amplitude_m=0.08",),
}
BOOM, FOREARM = 1.1, 0.8  # of the arm, whose forearm has more and more sections [m]
SECTIONS = range(2, 6)
EPISODES = {"paper": 400, "planner": 400}  # of a run
CONFIGS = {"paper": "paper.ini", "planner": "default.ini"}
STUDY_RUNS = (1, 2, 4, 8)
STUDY_EPISODES = 60
LEVELS = (0.0, 0.3, 0.0, -0.3)  # of an actuator, decision after decision
PERIOD = 0.5  # of a decision [s]


def say(text):
    print(text, file=sys.stderr, flush=True)


# --- a step of the simulator ---


def drive(plant, periods, actuators, begin=0):
    """Crawlers ahead, joints to and fro, each in a rhythm of its own."""
    for i in range(begin, begin + periods):
        joints = [0.4 * LEVELS[(i // (1 + k)) % 4] for k in range(actuators - 2)]
        plant.run(PERIOD, 0.0, 0.3, *joints)


def seconds_per_step(robot, actuators, settings=(), periods=200):
    """The least of some stretches: what else the machine does only adds to it."""
    from limphome_lab.measure.instrument import LEFT_LOCKED, Instrument  # NumPy is there once all is set up

    with Instrument((*LEFT_LOCKED, *settings), robot) as plant:
        drive(plant, 4, actuators)
        before, seconds = plant.report(), []
        for i in range(ROUNDS):
            drive(plant, periods // ROUNDS, actuators, 4 + i * periods // ROUNDS)
            after = plant.report()
            seconds.append((after.cpu_s - before.cpu_s) / (after.time - before.time) * step_s())
            before = after
    return min(seconds)


def step_s():
    from limphome_lab.measure.bench_simulator import OUR_STEP

    return OUR_STEP


def template(folder, sections):
    """A robot whose arm has so many sections."""
    lengths = [BOOM, *[FOREARM / (sections - 1)] * (sections - 1)]
    words = ["--template", "--arm", ",".join(map(str, lengths))]
    file = folder / f"arm{sections}.urdf"
    result = subprocess.run([sys.executable, "-m", "limphome_lab.show.robot", *words], capture_output=True, text=True)
    if result.returncode != 0:
        raise Ending(f"no robot with an arm of {sections} sections: {result.stderr}")
    file.write_text(result.stdout)
    return file


def over_joints():
    """[[joints, seconds]] of robots whose arms have more and more sections; the swing counts."""
    with tempfile.TemporaryDirectory() as folder:
        return [[1 + n, seconds_per_step(template(Path(folder), n), 3 + n)] for n in SECTIONS]


def over_grounds():
    """{ground: seconds}."""
    robot = paths.CONFIG / "crawler.urdf"
    return {name: seconds_per_step(robot, 5, settings) for name, settings in GROUNDS.items()}


def over_contacts():
    """{ground: [[contacts, seconds]]} of short stretches."""
    from limphome_lab.measure.instrument import LEFT_LOCKED, Instrument

    points = {"level": [], "rough": []}
    for ground, found in points.items():
        with Instrument((*LEFT_LOCKED, *GROUNDS[ground])) as plant:
            before = plant.report()
            for i in range(150):
                drive(plant, 1, 5, i)
                after = plant.report()
                seconds = (after.cpu_s - before.cpu_s) / (after.time - before.time) * step_s()
                found.append([(len(before.contacts) + len(after.contacts)) / 2, seconds])
                before = after
    return points


# --- a decision ---


def decisions():
    """{curve: [[x, seconds]]} by bench_growth."""
    program = paths.BUILD / "bench" / "bench_growth"
    result = subprocess.run([program], capture_output=True, text=True)
    if result.returncode != 0:
        raise Ending(f"{program}: exit code {result.returncode}\n{result.stderr}")
    curves = {}
    for line in result.stdout.splitlines():
        curve, x, seconds = line.split()
        curves.setdefault(curve, []).append([int(x), float(seconds)])
    return curves


# --- a run ---


def descendants(pid):
    """Process ids."""
    for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split():
        yield int(child)
        yield from descendants(int(child))


def memory_of(pid):
    """Resident memory of the programs below a process [MB]."""
    total = 0
    try:
        for child in descendants(pid):
            proc = Path(f"/proc/{child}")
            if (proc / "comm").read_text().startswith("limphome"):
                total += int((proc / "statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (FileNotFoundError, ProcessLookupError):  # one has just ended
        return 0
    return total / 1e6


def episodes_in(folder):
    try:
        return max(0, len((folder / "episodes.csv").read_text().splitlines()) - 1)
    except FileNotFoundError:
        return 0


def size_of(folder):
    return sum(file.stat().st_size for file in folder.rglob("*") if file.is_file()) / 1e6


def over_episodes(name):
    """[[episodes, MB of memory, MB on the disk, wall seconds]] while a run goes on."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "run"
        words = ["--config", paths.CONFIG / CONFIGS[name], "--episodes", EPISODES[name], "--out", out]
        words = [sys.executable, "-m", "limphome_lab.run.train", *map(str, words), "--quiet", "--no-figures"]
        began = time.monotonic()
        process = subprocess.Popen(words, stdout=subprocess.DEVNULL)
        points = []
        try:
            while process.poll() is None:
                done, memory = episodes_in(out), memory_of(process.pid)
                if memory > 0 and done > (points[-1][0] if points else 0):
                    points.append([done, memory, size_of(out), time.monotonic() - began])
                time.sleep(0.1)
        finally:
            process.terminate()
            process.wait()
    if process.returncode != 0 or not points:
        raise Ending(f"the run of {CONFIGS[name]} ended with exit code {process.returncode}")
    return points


# --- a study ---

STUDY = """\
episodes = {episodes}
[seeds]
tuning = ["1-{runs}"]
[variants.planner]
config = "default.ini"
[failures.left_locked]
failure.actuator = "left_crawler"
failure.mode = "locked"
[grounds.flat]
"""


def study_seconds(runs, cores):
    with tempfile.TemporaryDirectory() as folder:
        table = Path(folder) / "growth.toml"
        table.write_text(STUDY.format(episodes=STUDY_EPISODES, runs=runs))
        words = [sys.executable, "-m", "limphome_lab.study.study", table, "--out", f"{folder}/study", "--cores", cores]
        began = time.monotonic()
        result = subprocess.run([*map(str, words)], capture_output=True, text=True)
        if result.returncode != 0:
            raise Ending(f"the study of {runs} runs ended with exit code {result.returncode}\n{result.stderr}")
        return time.monotonic() - began


def over_runs():
    """{cores: [[runs, seconds]]}"""
    most = len(os.sched_getaffinity(0))
    cores = sorted({1, most} | {n for n in (2, 4, 8, 16) if n < most})
    return {n: [[runs, study_seconds(runs, n)] for runs in STUDY_RUNS] for n in cores}


MEASURED = {
    "step_over_joints": over_joints,
    "step_over_contacts": over_contacts,
    "step_over_grounds": over_grounds,
    "decision": decisions,
    "run_paper": lambda: over_episodes("paper"),
    "run_planner": lambda: over_episodes("planner"),
    "study": over_runs,
}


@with_exit_code
def main():
    parser = command.parser(
        "growth",
        "Measures how the costs of step, decision, run and study grow, and draws it. Takes minutes on an idle machine.",
        "growth",
    )
    parser.add_argument("out", metavar="DIR", type=Path, help="folder for growth.json and the figures")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    network.enter("private")
    measured = {}
    for name, measure in MEASURED.items():
        say(f"measuring {name}")
        measured[name] = measure()
    (args.out / "growth.json").write_text(json.dumps(measured, indent=1) + "\n")
    from limphome_lab.measure.growth_figures import draw  # matplotlib takes a while to load

    for file in draw(json.loads((args.out / "growth.json").read_text()), args.out):
        print(paths.shown(file))
    return 0


if __name__ == "__main__":
    sys.exit(main())
