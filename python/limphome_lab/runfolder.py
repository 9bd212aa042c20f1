"""The folder a run leaves behind: what lies in it, how it is made and how its table is read."""

import configparser
import csv
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass, fields
from pathlib import Path

from limphome_lab import command, describe, files, lock, paths
from limphome_lab.ending import InputError

CHECKPOINT = re.compile(r"episode_\d{6,}\.lcm")


@dataclass
class Episode:
    """One row of episodes.csv; the names are those of its header."""

    episode: int
    outcome: str
    steps: int
    duration_s: float
    reward: float
    reward_motion: float
    reward_goal: float
    reward_stability: float
    reward_tumble: float
    lateral_error_m: float
    heading_change_rad: float
    temperature: float

    @classmethod
    def from_row(cls, row):
        return cls(*(field.type(text) for field, text in zip(fields(cls), row, strict=True)))


class RunFolder:
    """Paths inside a run folder."""

    def __init__(self, path):
        self.path = Path(path).absolute()
        self.config = self.path / "config.ini"
        self.robot = self.path / "robot.urdf"
        self.meshes = self.path / "robot_meshes"  # where the programs look for them first
        self.episodes = self.path / "episodes.csv"
        self.policy = self.path / "policy.lcm"
        self.checkpoints = self.path / "checkpoint"
        self.messages = self.path / "messages.lcmlog"
        self.manifest = self.path / "manifest.json"
        self.figures = self.path / "figures"
        self.lock = self.path / "lock"  # of run/lock.py

    def take(self):
        """Takes the folder for this process until it ends; InputError where another works there."""
        self._held = lock.take(self.lock)

    def leave(self):
        """Gives it up before that."""
        self._held.close()

    def others(self):
        """All that lies there but the lock."""
        return [file for file in self.path.iterdir() if file != self.lock]

    def settings(self):
        return parse_settings(self.config.read_text(errors="replace"), self.config)

    def checkpoint_files(self):
        """The oldest first; whatever else lies there is none."""
        files = [file for file in self.checkpoints.iterdir() if CHECKPOINT.fullmatch(file.name)]
        return sorted(files, key=lambda file: int(file.stem.removeprefix("episode_")))

    def read_episodes(self):
        return EpisodeTail(self.episodes).read_new()


def parse_settings(text, source):
    """The configparser of an INI file as the controller has resolved it; InputError where somebody changed it since."""
    parser = configparser.ConfigParser()
    try:
        parser.read_string(text, str(source))
    except configparser.Error as error:
        raise InputError(str(error)) from error
    return parser


class EpisodeTail:
    """Follows episodes.csv while it is written."""

    def __init__(self, path):
        self.path = path
        self._offset = 0

    def read_new(self):
        """Rows that were completed since the last call. A file cut short, as when resuming, is read anew."""
        try:
            with open(self.path, "rb") as file:
                if file.seek(0, 2) < self._offset:
                    self._offset = 0
                file.seek(self._offset)
                text = file.read()
        except FileNotFoundError:
            return []
        complete = text[: text.rfind(b"\n") + 1]
        lines = complete.decode(errors="replace").splitlines()
        if self._offset == 0 and lines:
            _check_header(self.path, lines.pop(0))
        self._offset += len(complete)
        return [self._episode(row) for row in csv.reader(lines)]

    def _episode(self, row):
        try:
            return Episode.from_row(row)
        except ValueError as error:
            raise InputError(f"{self.path}: {','.join(row)!r} is no row of an episode: {error}") from error


def _check_header(path, header):
    expected = ",".join(field.name for field in fields(Episode))
    if header != expected:
        raise InputError(f"{path}: the header is {header!r}, not {expected!r}")


def named(path):
    """The path itself, or InputError where it is empty, as a variable of the shell that was not set is."""
    if not str(path):
        raise InputError("the name of a run folder is empty")
    return path


def existing(path, *needed):
    """The run folder at `path`, or InputError where one of the `needed` files (attributes' names) is missing."""
    folder = RunFolder(named(path))
    for name in ("config", "robot", *needed):
        file = getattr(folder, name)
        try:
            file.stat()
        except FileNotFoundError:
            raise InputError(f"{path}: not a run folder that can be used here: {file.name} is missing") from None
        except OSError as error:
            raise InputError(f"{path}: not a run folder that can be used here: {error.strerror}") from error
    return folder


def ask(program, *options, tell=True):
    """What a program prints that ends at once; with `tell`, its notices are told. Raises InputError with its words
    where it refuses what it is given."""
    command = [paths.program(program), *map(str, options)]
    # file names need not be UTF-8
    result = subprocess.run(command, capture_output=True, text=True, errors="surrogateescape")
    if result.returncode != 0:
        raise InputError(result.stderr.strip())
    if result.stderr and tell:
        print(result.stderr, end="", file=sys.stderr)
    return result.stdout


def setting_options(config, assignments):
    """Options of both programs."""
    return ["--config", config, *(word for assignment in assignments for word in ("--set", assignment))]


def resolve_settings(config, assignments):
    """Text of an INI file with every setting, checked by the controller."""
    try:
        return ask("controller", *setting_options(config, assignments), "--print-settings")
    except InputError as error:
        hint = "" if Path(config).exists() else command.did_you_mean(config, ".ini")
        raise InputError(f"{error}{hint}") from error


def find_robot(robot):
    """`robot`, or the one that comes along where it is named without a folder and is not here: as --config is found."""
    own = paths.CONFIG / robot
    return own if Path(robot).name == str(robot) and not Path(robot).exists() and own.is_file() else Path(robot)


def create(out, config, robot, assignments, controller_options=(), anew=False, real_time=False, packages=None):
    """Makes a run folder with its inputs, config.ini as resolved, robot.urdf and its meshes, and takes it for this
    process. `out` None: a new one below runs/. With `anew`, what an earlier run left there is removed. Without
    `real_time` there will be no operator, and a plant that waits to be armed is refused. `packages`: where package://
    lies, as of the programs.

    Both programs read all of them before, with `controller_options`, so that what is bad leaves no folder behind."""
    robot = find_robot(robot)
    resolved = resolve_settings(config, assignments)
    pace = parse_settings(resolved, config)["simulator"]["pace"]
    if real_time and pace != "real_time":
        raise InputError(f"simulator.pace = {pace}: this is for real time only")
    if not real_time and pace == "real_time":
        launch = f"{command.called('launch')} --arm"
        raise InputError(f"simulator.pace = real_time: the plant would wait for ever to be armed; {launch} arms it")
    named = ["--robot", robot, *describe.options(packages)]
    options = [*setting_options(config, assignments), *named, "--check"]
    if not robot.exists():
        hint = command.did_you_mean(robot, ".urdf")
        raise InputError(f"{robot}: cannot be opened: No such file or directory{hint}")
    ask("controller", *options, *controller_options)
    ask("simulator", *options, tell=False)  # of the same robot, so the same notices
    meshes = dict(line.split("\t") for line in ask("controller", *named, "--list-meshes").splitlines())
    if out is None:
        seed = parse_settings(resolved, config)["learning"]["seed"]
        out = paths.new_run(f"{Path(config).stem}-seed{seed}")
    folder = RunFolder(out)
    try:
        _take_empty(folder, out, anew)
        _write_inputs(folder, resolved, Path(robot).read_bytes(), meshes)
    except OSError as error:
        raise InputError(f"{out}: cannot be made a run folder: {error.strerror}") from error
    return folder


def _write_inputs(folder, config, robot, meshes):
    """All, or none."""
    try:
        files.replace(folder.config, config)
        for copy, mesh in meshes.items():
            folder.meshes.mkdir(exist_ok=True)
            files.replace(folder.path / copy, Path(mesh).read_bytes())
        files.replace(folder.robot, robot)
    except OSError:
        folder.config.unlink(missing_ok=True)
        shutil.rmtree(folder.meshes, ignore_errors=True)
        raise


def _begun(folder):
    """Whether there is more than what a script leaves that was killed while it made the folder."""
    made = {name for file in (folder.config, folder.robot, folder.manifest) for name in (file.name, f"{file.name}.new")}
    made = made - {folder.manifest.name} | {folder.meshes.name}
    return any(file.name not in made for file in folder.others())


def _take_empty(folder, out, anew):
    """Makes the folder, if need be, and takes it; what is there, unless it may be removed, is left as it is."""
    taken = f"{out}: exists and is not an empty folder; give another, or go on with it by --resume"
    if folder.path.exists() and not (folder.path.is_dir() and (anew or not _begun(folder))):
        raise InputError(taken)
    folder.path.mkdir(parents=True, exist_ok=True)
    folder.take()
    if _begun(folder) and not anew:
        raise InputError(taken)
    for file in folder.others():
        shutil.rmtree(file) if file.is_dir() and not file.is_symlink() else file.unlink()
