"""What a study has to do: its runs, each with the commands that make it and the folder that it leaves.

The name of a folder ends with the fingerprint of all that the run follows from: effective settings (seed and episodes
among them), robot and programs. So a folder that is there is what the table asks for, and where something has changed
the run is another, done anew beside the old one.
"""

import configparser
import functools
import hashlib
import json
import sys
from dataclasses import dataclass, field
from pathlib import Path

from limphome_lab import paths, runfolder
from limphome_lab.run import manifest
from limphome_lab.study import reference

FINGERPRINT = 8  # hexadecimal digits in a name
EVALUATION_EPISODES = 1


@dataclass
class Run:
    case: object  # table.Case
    seed: int
    fingerprint: str
    train: list  # words of the command, without --out
    evaluations: dict = field(
        default_factory=dict
    )  # by name: (folder's name, words of the command, without RUN, --out)

    @property
    def name(self):
        return f"{self.case.name}-seed{self.seed}-{self.fingerprint}"


class Plan:
    """The runs of a table, with the folders of the study in `out`. `together`: each as one process."""

    def __init__(self, table, out, together=True):
        self.table = table
        self.programs = (manifest.TOGETHER,) if together else manifest.PROCESSES
        self.how = ["--one-process"] if together else []
        self.out = Path(out).absolute()
        self.runs = [self._run(case, seed) for case in table.cases for seeds in table.seeds.values() for seed in seeds]

    def folder(self, run):
        return self.out / "runs" / run.name

    def evaluation_folder(self, run, name):
        return self.out / "evaluations" / run.evaluations[name][0]

    def folders(self):
        """All that there will be."""
        for run in self.runs:
            yield self.folder(run)
            yield from (self.evaluation_folder(run, name) for name in run.evaluations)

    def write(self):
        """plan.json, which the Snakefile reads: the commands by the folders they leave."""
        commands = {
            "runs": {run.name: run.train for run in self.runs},
            "evaluations": {
                folder: {"run": run.name, "command": words}
                for run in self.runs
                for folder, words in run.evaluations.values()
            },
        }
        (self.out / "plan.json").write_text(json.dumps(commands, indent=1) + "\n")

    def _run(self, case, seed):
        where = f"{self.table.path}: {case.name}"
        config = self._found(case.variant.get("config", "paper.ini"))
        robot = self._found(case.variant.get("robot", "crawler.urdf"))
        episodes = case.variant.get("episodes", self.table.episodes)
        assignments = [*case.settings, f"learning.seed={seed}"]
        if episodes is not None:
            assignments.append(f"learning.episodes={episodes}")
        settings = _resolved(config, assignments, where)
        if not robot.is_file():
            raise runfolder.InputError(f"{where}: robot {robot}: no such file")
        learns = not case.variant.get("reference", False)
        programs = _digests(self.programs if learns else (reference.PROGRAM,))
        fingerprint = fingerprint_of(settings, {"robot": manifest.digest(robot), **programs})
        words = ["--config", config, "--robot", robot, *_set(assignments)]
        if not learns:
            return Run(case, seed, fingerprint, _module("study.reference", *words))
        run = Run(case, seed, fingerprint, _module("run.train", *words, *self.how, "--no-figures", "--quiet"))
        for entry in self.table.evaluations:
            self._add_evaluation(run, entry, config, assignments)
        return run

    def _add_evaluation(self, run, entry, config, assignments):
        where = f"{self.table.path}: evaluations.{entry.name} of {run.case.name}"
        _resolved(config, [*assignments, *entry.settings], where)
        options = {"episodes": EVALUATION_EPISODES, **entry.own}
        words = [word for key, value in options.items() for word in (f"--{key}", value)] + _set(entry.settings)
        mark = _hash([run.fingerprint, *map(str, words)])
        folder = f"{run.case.name}-seed{run.seed}-{entry.name}-{mark}"
        run.evaluations[entry.name] = (folder, _module("run.evaluate", *words, *self.how))

    def _found(self, name):
        """A file named in the table: beside it, else one of those that come along."""
        beside = self.table.path.parent / name
        return (beside if beside.exists() or Path(name).name != name else paths.CONFIG / name).absolute()


@functools.cache
def _digests(programs):
    return manifest.program_digests(programs)


def fingerprint_of(settings, digests):
    """`settings`: {section: {key: value}}; `digests`: of robot and programs, as in manifest.json."""
    return _hash([settings, digests])


def is_asked_for(run, manifest):
    """Whether the run that left this manifest followed from what its folder's name says."""
    return fingerprint_of(manifest["settings"], manifest["digests"]) == run.fingerprint


def _hash(value):
    text = json.dumps(value, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:FINGERPRINT]


def _resolved(config, assignments, where):
    """{section: {key: value}} of every setting, checked by the controller."""
    try:
        text = runfolder.resolve_settings(config, assignments)
    except runfolder.InputError as error:
        raise runfolder.InputError(f"{where}: {error}") from error
    parser = configparser.ConfigParser()
    parser.read_string(text)
    return manifest.as_dict(parser)


def _set(assignments):
    return [word for assignment in assignments for word in ("--set", assignment)]


def _module(command, *words):
    return [sys.executable, "-m", f"limphome_lab.{command}", *map(str, words)]
