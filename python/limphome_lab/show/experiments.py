"""Runs side by side: which of them are one experiment with other seeds, and what tells the experiments apart."""

import json
import re
import string
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from limphome_lab import runfolder
from limphome_lab.runfolder import InputError

NEUTRAL = {("learning", "seed"), ("simulator", "pace")}  # of one experiment, whatever they are
NEUTRAL_SECTIONS = ("recording", "link")
LEARNER = ("learner", "learning", "rbf", "exploration", "planner", "reward", "action", "safety", "evaluation")
ROBOT_NAME = re.compile(r"<robot\b[^>]*\bname\s*=\s*[\"']([^\"']*)")


class Run:
    """A run that has finished, training or evaluation."""

    def __init__(self, path):
        self.folder = runfolder.existing(path, "episodes", "manifest")
        try:
            self.manifest = json.loads(self.folder.manifest.read_text())
            self.finished = self.manifest.get("result") == "finished"
        except (ValueError, AttributeError) as error:
            raise InputError(f"{path}: manifest.json is no manifest of a run") from error
        self.settings = self.folder.settings()
        self.seed = int(self.settings["learning"]["seed"])

    @cached_property
    def episodes(self):
        return self.folder.read_episodes()

    @cached_property
    def facts(self):
        """{"section.key" or "robot" or "kind": value} of all that makes it another experiment."""
        text = self.folder.robot.read_text(errors="replace")
        named = ROBOT_NAME.search(text)
        settings = {
            f"{section}.{key}": canonical(value)
            for section in self.settings.sections()
            for key, value in self.settings[section].items()
            if (section, key) not in NEUTRAL and section not in NEUTRAL_SECTIONS
        }
        return {"robot": (named[1] if named else "", text), "kind": self.manifest.get("kind", "training"), **settings}

    @property
    def builds(self):
        """Digests of the programs that made it."""
        return {name: sum_ for name, sum_ in self.manifest.get("digests", {}).items() if name != "robot"}


def canonical(value):
    """A number as single precision has it, whatever digits it was written with; another value as it is."""
    try:
        return f"{float(value):.6g}"
    except ValueError:
        return value


@dataclass
class Experiment:
    """Runs that differ in their seed alone."""

    letter: str
    differs: dict  # "section.key" and the like, where not all experiments have the same
    runs: list = field(default_factory=list)  # in the order of their seeds

    @property
    def name(self):
        return " ".join(f"{key}={value}" for key, value in self.differs.items())


def find(given):
    """([Run], [what was passed over, and why]) of run folders, folders of runs, and folders of studies."""
    runs, told = [], []
    for path in map(Path, given):
        folders = [path] if is_run(path) else runs_within(path)
        for folder in folders:
            try:
                run = Run(folder)
            except InputError as error:
                if folder is path:
                    raise
                told.append(f"passed over {error}")
                continue
            if not run.finished or not run.episodes:
                told.append(f"passed over {folder}: the run has not finished")
            elif all(each.folder.path != run.folder.path for each in runs):
                runs.append(run)
    if not runs:
        raise InputError("\n".join([*told, "there is no run that has finished among these"]))
    return runs, told


def is_run(path):
    return (path / "config.ini").is_file()


def runs_within(path):
    """Those directly in a folder, or in the runs/ of a study."""
    place = path / "runs" if (path / "plan.json").is_file() else path
    folders = sorted(filter(is_run, place.iterdir())) if place.is_dir() else []
    if not folders:
        raise InputError(f"{path}: neither a run folder, nor a folder that has some in it")
    return folders


def group(runs):
    """([Experiment], [what is to be told]): those first that come first. No seed counts twice in one."""
    alike = {}
    for run in runs:
        alike.setdefault(tuple(sorted(run.facts.items())), []).append(run)
    keys = dict.fromkeys(key for run in runs for key in run.facts)
    differing = [key for key in keys if len({run.facts.get(key) for run in runs}) > 1]
    experiments, told = [], []
    for number, members in enumerate(alike.values()):
        of_seed = {}
        for run in members:
            if run.seed in of_seed:
                told.append(
                    f"passed over {run.folder.path.name}: {of_seed[run.seed].folder.path.name} is the same, seed too"
                )
            of_seed.setdefault(run.seed, run)
        differs = {key: _shown(members[0], key, runs) for key in differing}
        experiments.append(Experiment(letter(number), differs, [of_seed[seed] for seed in sorted(of_seed)]))
    return experiments, told + [*_not_alike(differing), *_builds(runs)]


def letter(number):
    """A to Z, then AA, AB and so on."""
    letters = string.ascii_uppercase
    return (letter(number // 26 - 1) if number >= 26 else "") + letters[number % 26]


def _shown(run, key, runs):
    """A value as it is told; robots of one name are told apart by the name of a run."""
    value = run.facts.get(key, "")
    if key != "robot":
        return value
    name, text = value
    twins = [each for each in runs if each.facts["robot"][0] == name]
    first = next(each for each in twins if each.facts["robot"][1] == text)
    return name if len({each.facts["robot"] for each in twins}) == 1 else f"{name}({first.folder.path.name})"


def _not_alike(differing):
    """Where the experiments are not only other learners."""
    others = [key for key in differing if key.partition(".")[0] not in LEARNER]
    return [f"not the same task: other {', '.join(others)}"] if others else []


def _builds(runs):
    builds = {json.dumps(run.builds, sort_keys=True) for run in runs}
    return [f"made by {len(builds)} builds of the programs"] if len(builds) > 1 else []
