"""Decisions and episodes as tables, Parquet or CSV: a column for each number of a message, with its field's name.

decisions: a row for each decision, with the state decided upon and, behind `episode_`, how its episode ended; that is
empty where the recording ends before the episode does. episodes: a row for each episode. What follows from the order of
messages holds here, too: the reward in the row of step 0 is that of the last step of the episode before.
"""

import contextlib

import pyarrow
import pyarrow.csv
import pyarrow.parquet

from limphome import decision_t
from limphome_lab import describe, files
from limphome_lab.channels import DECISION, EPISODE, STATE
from limphome_lab.ending import InputError
from limphome_lab.messages import OUTCOMES
from limphome_lab.show.share import Share
from limphome_lab.timeline import timeline

ROWS = 5000  # that are written at a time
COMMON = ("utime", "session", "seq")  # of a state and the decision on it
LINK = ("reset_sender", "reset_nonce", "reset", "sent", "lockstep", "armed", "challenge", "num_actuators")  # left out
AXES = {"position": "xyz", "orientation": "wxyz", "start": "xy"}
OF_EPISODE = "episode_"


def write_parquet(folder, out):
    return _write(folder, out, "parquet", lambda path, schema: pyarrow.parquet.ParquetWriter(path, schema))


def write_csv(folder, out):
    return _write(folder, out, "csv", lambda path, schema: pyarrow.csv.CSVWriter(path, schema))


def _write(folder, out, suffix, writer):
    """Both tables of a run into the folder `out`; returns their files."""
    actuators = [actuator["name"] for actuator in describe.ask(folder.robot)[1]["actuators"]]
    paths = [out / f"{name}.{suffix}" for name in ("decisions", "episodes")]
    with contextlib.ExitStack() as stack:
        decisions, episodes = (stack.enter_context(Table(path, writer)) for path in paths)
        waiting = []  # decisions whose episode has not ended
        for time, message, state in _decisions_and_episodes(folder.messages):
            if isinstance(message, decision_t):
                waiting.append(decision_row(time, message, state, actuators))
                continue
            row = episode_row(time, message)
            episodes.add(row)
            ending = {OF_EPISODE + name: value for name, value in row.items() if name not in ("episode", "session")}
            for decision in waiting:
                if decision["session"] == message.session and decision["episode"] == message.episode:
                    decisions.add(decision | ending)
                elif not _begins_next(decision, message):
                    decisions.add(decision)  # of an episode that was broken off and begun anew
            waiting = [decision for decision in waiting if _begins_next(decision, message)]
        for decision in waiting:
            decisions.add(decision)
        if episodes.empty or decisions.empty:
            raise InputError(f"{folder.path}: no episode has ended, so there is no table to write")
    return paths


def _decisions_and_episodes(log):
    """Yields (time [us], message, state): decision_t with the robot_state_t decided upon, None where that was thinned
    out, and episode_t with None."""
    state = None
    with Share("reading", log.stat().st_size) as share:
        for time, channel, message in timeline(log, share.update):
            if channel == STATE:
                state = message
            elif channel == DECISION:
                known = state and (state.session, state.seq) == (message.session, message.seq)
                yield time, message, state if known else None
            elif channel == EPISODE:
                yield time, message, None


def _begins_next(decision, episode):
    """Where an episode ends without a reset, the next one's first decision comes before the message of its end."""
    return decision["session"] == episode.session and decision["episode"] > episode.episode


def decision_row(time, decision, state, actuators):
    """{column: value}; `actuators`: their names."""
    row = {"time": time / 1e6, **flat(decision, {"inputs": range(decision.num_inputs)})}
    return row | flat(state, actuators_named(state, actuators), without=(*COMMON, *LINK)) if state else row


def episode_row(time, episode):
    return {"time": time / 1e6, **flat(episode, {}), "outcome": OUTCOMES[episode.outcome]}


def actuators_named(state, actuators):
    """Suffixes of the fields that have an entry for each actuator."""
    return {name: actuators for name in type(state).__slots__ if name.startswith("actuator_")}


def flat(message, named, without=()):
    """{column: value} of a message; fields with several entries become a column for each of those that `named`, else
    AXES, gives a suffix."""
    row = {}
    for field in type(message).__slots__:
        value = getattr(message, field)
        if field in without:
            continue
        if isinstance(value, (int, float)):
            row[field] = value
        else:
            suffixes = named.get(field, AXES.get(field))
            row |= {f"{field}_{suffix}": entry for suffix, entry in zip(suffixes, value, strict=False)}
    return row


class Table:
    """A file to which rows are added. Its columns are those of its first rows, of which not each has all."""

    def __init__(self, path, writer):
        self.empty = True
        self._rows = []
        self._path, self._writer = path, writer
        self._schema = None
        self._open = contextlib.ExitStack()

    def __enter__(self):
        self._open.__enter__()
        self._fresh = self._open.enter_context(files.replacing(self._path))
        return self

    def __exit__(self, *error):
        if self._rows and error[0] is None:
            self._flush()
        return self._open.__exit__(*error)

    def add(self, row):
        self.empty = False
        self._rows.append(row)
        if len(self._rows) == ROWS:
            self._flush()

    def _flush(self):
        if not self._schema:
            kinds = {int: pyarrow.int64(), float: pyarrow.float64(), str: pyarrow.string()}
            columns = {name: kinds[type(value)] for row in self._rows for name, value in row.items()}
            self._schema = pyarrow.schema(columns.items())
            self._file = self._open.enter_context(self._writer(self._fresh, self._schema))
        self._file.write_table(pyarrow.Table.from_pylist(self._rows, self._schema))
        self._rows.clear()
