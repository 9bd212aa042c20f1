"""The table of a study: a TOML file that says which runs there are. docs/study.md explains it by an example."""

import re
import tomllib
from dataclasses import dataclass
from pathlib import Path

from limphome_lab import command
from limphome_lab.runfolder import InputError

NAME = re.compile(r"[A-Za-z0-9_]+")
SEEDS = re.compile(r"(\d+)-(\d+)")
SEED_MAX = 2147483647
SECTIONS = ("variants", "failures", "grounds", "evaluations")
SIDES = ("variants", "failures", "grounds")  # of a cross, each with each
USES = ("tuning", "test")  # of seeds
GIVEN = {"learning.seed": "seeds", "learning.episodes": "episodes"}  # settings that a table says in its own words
SELECTIONS = ("greedy", "boltzmann")
OWN = {  # keys of an entry beside the settings it makes
    "variants": {"config": str, "robot": str, "episodes": int, "hard": bool, "reference": bool},
    "failures": {"hard": bool},
    "grounds": {"hard": bool},
    "evaluations": {"episodes": int, "selection": str, "average": int},
}
WORDS = {str: "a text", int: "a whole number from 1", bool: "true or false", dict: "a table"}


@dataclass(frozen=True)
class Entry:
    """A named variant, failure, ground or evaluation: what it sets, and its own keys beside."""

    name: str
    settings: tuple  # "section.key=value" of the experiment
    own: dict

    def get(self, key, otherwise=None):
        return self.own.get(key, otherwise)


@dataclass(frozen=True, eq=False)
class Case:
    """One line of the report: a variant that meets a failure on a ground, with every seed."""

    variant: Entry
    failure: Entry
    ground: Entry

    @property
    def name(self):
        return f"{self.variant.name}-{self.failure.name}-{self.ground.name}"

    @property
    def hard(self):
        """Whether the limit of 9 s is out of reach there."""
        return any(entry.get("hard", False) for entry in (self.variant, self.failure, self.ground))

    @property
    def settings(self):
        return [*self.variant.settings, *self.failure.settings, *self.ground.settings]


@dataclass(frozen=True)
class Table:
    path: Path
    episodes: int | None  # None: as the variants' experiments have it
    seeds: dict  # "tuning" and "test": list of numbers
    cases: list
    evaluations: list  # of Entry

    @property
    def name(self):
        return self.path.stem


class _Reader:
    """Reads one file; what is wrong ends in an error that names file, key and what is allowed."""

    def __init__(self, path):
        self.path = path

    def refuse(self, key, allowed):
        raise InputError(f"{self.path}: {key}: {allowed}")

    def load(self):
        try:
            return tomllib.loads(self.path.read_text())
        except OSError as error:
            hint = "" if self.path.exists() else command.did_you_mean(self.path, ".toml")
            raise InputError(f"{self.path}: cannot be read: {error.strerror}{hint}") from error
        except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
            raise InputError(f"{self.path}: not TOML: {error}") from error

    def typed(self, value, kind, key):
        # a bool is an int to Python
        if type(value) is not kind or (kind is int and value < 1):
            self.refuse(key, f"must be {WORDS[kind]}")
        return value

    def known(self, table, allowed, key):
        for name in table:
            if name not in allowed:
                self.refuse(f"{key}.{name}" if key else name, f"not known; allowed are {', '.join(allowed)}")

    def numbers(self, given, key):
        """Seeds: whole numbers and ranges such as "101-136"."""
        allowed = f'must be a list of seeds from 0 to {SEED_MAX} and ranges such as "101-136", none of them twice'
        if not isinstance(given, list):
            self.refuse(key, allowed)
        seeds = []
        for each in given:
            span = SEEDS.fullmatch(each) if isinstance(each, str) else None
            if span and int(span[1]) <= int(span[2]) <= SEED_MAX:
                seeds += range(int(span[1]), int(span[2]) + 1)
            elif type(each) is int and 0 <= each <= SEED_MAX:
                seeds.append(each)
            else:
                self.refuse(key, allowed)
        if len(set(seeds)) < len(seeds):
            self.refuse(key, allowed)
        return seeds

    def entry(self, section, name, table):
        key = f"{section}.{name}"
        if not NAME.fullmatch(name):
            self.refuse(key, "a name is made of letters, digits and _")
        own, settings = {}, []
        for word, value in self.typed(table, dict, key).items():
            if word in OWN[section]:
                own[word] = self.typed(value, OWN[section][word], f"{key}.{word}")
            elif isinstance(value, dict):
                settings += [self.assignment(f"{word}.{each}", value[each], key) for each in value]
            else:
                self.refuse(
                    f"{key}.{word}",
                    f"not known; allowed are {', '.join(OWN[section])} and settings as section.key = value",
                )
        return Entry(name, tuple(settings), own)

    def assignment(self, name, value, key):
        if type(value) not in (str, int, float):
            self.refuse(f"{key}.{name}", "a setting must be a number or a text")
        if name in GIVEN:
            self.refuse(f"{key}.{name}", f"is given by {GIVEN[name]}")
        return f"{name}={value}"

    def entries(self, data, section):
        return {name: self.entry(section, name, table) for name, table in self.section(data, section).items()}

    def section(self, data, name):
        return self.typed(data.get(name, {}), dict, name)

    def cases(self, data, entries):
        """Those of every [[cross]], in their order; without any, each variant with each failure on each ground."""
        crosses = data.get("cross", [{}])
        if not isinstance(crosses, list):
            self.refuse("cross", "must be written as [[cross]]")
        found = {}
        for number, cross in enumerate(crosses, 1):
            key = f"cross {number}"
            self.known(self.typed(cross, dict, key), SIDES, key)
            sides = [self.side(cross.get(side), side, entries[side], key) for side in SIDES]
            for case in (Case(*three) for three in _each_with_each(*sides)):
                found[case.name] = case
        return list(found.values())

    def side(self, names, side, entries, key):
        """Entries of one side of a cross; all where none is named."""
        if names is None:
            return list(entries.values())
        if not isinstance(names, list) or not names or any(name not in entries for name in map(str, names)):
            self.refuse(f"{key}.{side}", f"must be a list of some of {', '.join(entries)}")
        return [entries[name] for name in names]


def _each_with_each(variants, failures, grounds):
    return [(variant, failure, ground) for variant in variants for failure in failures for ground in grounds]


def read(path):
    """The table in the file `path`. Raises InputError. Settings are not looked at here: the controller knows them."""
    reader = _Reader(Path(path))
    data = reader.load()
    reader.known(data, ("episodes", "seeds", "cross", *SECTIONS), "")
    seeds = reader.section(data, "seeds")
    reader.known(seeds, USES, "seeds")
    seeds = {use: reader.numbers(seeds.get(use, []), f"seeds.{use}") for use in USES}
    if set(seeds["tuning"]) & set(seeds["test"]):
        reader.refuse("seeds", "a seed is for tuning or for the test, not for both")
    if not seeds["tuning"] + seeds["test"]:
        reader.refuse("seeds", "must name some for tuning or test")
    entries = {section: reader.entries(data, section) for section in SECTIONS}
    for section in SIDES:
        if not entries[section]:
            reader.refuse(section, f"there must be at least one [{section}.NAME]")
    for name, entry in entries["evaluations"].items():
        if entry.get("selection", "greedy") not in SELECTIONS:
            reader.refuse(f"evaluations.{name}.selection", f"must be one of {', '.join(SELECTIONS)}")
    episodes = reader.typed(data["episodes"], int, "episodes") if "episodes" in data else None
    return Table(reader.path, episodes, seeds, reader.cases(data, entries), list(entries["evaluations"].values()))
