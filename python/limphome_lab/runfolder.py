"""The folder a run leaves behind: what lies in it, how it is made and how its table is read."""

import configparser
import csv
import shutil
import subprocess
import time
from dataclasses import dataclass, fields
from pathlib import Path

from limphome_lab import paths
from limphome_lab.ending import Ending


class InputError(Ending):
    """Something the user gave is wrong; nothing has been started."""

    exit_code = 2


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
        self.episodes = self.path / "episodes.csv"
        self.policy = self.path / "policy.lcm"
        self.checkpoints = self.path / "checkpoint"
        self.messages = self.path / "messages.lcmlog"
        self.manifest = self.path / "manifest.json"
        self.figures = self.path / "figures"

    def settings(self):
        parser = configparser.ConfigParser()
        parser.read_string(self.config.read_text())
        return parser

    def read_episodes(self):
        return EpisodeTail(self.episodes).read_new()

    def newest_checkpoint(self):
        """Episode after which the newest checkpoint was taken; 0 where there is none."""
        files = self.checkpoints.glob("episode_*.lcm")
        return max((int(file.stem.removeprefix("episode_")) for file in files), default=0)


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
        lines = complete.decode().splitlines()
        if self._offset == 0 and lines:
            _check_header(self.path, lines.pop(0))
        self._offset += len(complete)
        return [Episode.from_row(row) for row in csv.reader(lines)]


def _check_header(path, header):
    expected = ",".join(field.name for field in fields(Episode))
    if header != expected:
        raise InputError(f"{path}: the header is {header!r}, not {expected!r}")


def existing(path, *needed):
    """The run folder at `path`, or InputError where one of the `needed` files (attributes' names) is missing."""
    folder = RunFolder(path)
    for name in ("config", "robot", *needed):
        file = getattr(folder, name)
        if not file.exists():
            raise InputError(f"{path}: not a run folder that can be used here: {file.name} is missing")
    return folder


def resolve_settings(config, assignments):
    """Text of an INI file with every setting, checked by the controller. Raises InputError with its words."""
    command = [paths.program("controller"), "--config", config, "--print-settings"]
    for assignment in assignments:
        command += ["--set", assignment]
    result = subprocess.run(command, capture_output=True, text=True)
    if result.returncode != 0:
        raise InputError(result.stderr.strip())
    return result.stdout


def find_robot(robot):
    """`robot`, or the one that comes along where it is named without a folder and is not here: as --config is found."""
    own = paths.CONFIG / robot
    return own if Path(robot).name == str(robot) and not Path(robot).exists() and own.is_file() else Path(robot)


def create(out, config, robot, assignments):
    """Makes a run folder with its inputs: config.ini as resolved and robot.urdf. `out` None: a new one below runs/."""
    resolved = resolve_settings(config, assignments)
    robot = find_robot(robot)
    if not Path(robot).is_file():
        raise InputError(f"{robot}: cannot be opened: no such file")
    if out is None:
        parser = configparser.ConfigParser()
        parser.read_string(resolved)
        seed = parser["learning"]["seed"]
        out = paths.RUNS / f"{Path(config).stem}-seed{seed}-{time.strftime('%Y%m%d-%H%M%S')}"
    folder = RunFolder(out)
    if folder.path.exists() and (not folder.path.is_dir() or any(folder.path.iterdir())):
        raise InputError(f"{out}: exists and is not an empty folder; give another, or go on with it by --resume")
    try:
        folder.path.mkdir(parents=True, exist_ok=True)
        folder.config.write_text(resolved)
        shutil.copyfile(robot, folder.robot)
    except OSError as error:
        raise InputError(f"{out}: cannot be made a run folder: {error.strerror}") from error
    return folder
