"""Episodes of a recording, each as it can be looked at at any moment of it.

States come once per decision period. In between, positions and joints are taken to change at a constant rate and the
body to turn at one, about one axis (slerp): what is seen there is drawn, not recorded. Truth (contacts, forces, support
polygon) is not in a recording. The centre of mass is computed from the robot file; the margin is that which the
controller computed at the decision before.
"""

from bisect import bisect_right
from dataclasses import dataclass

import numpy as np

from limphome import decision_t, episode_t, robot_state_t
from limphome_lab import paths, quaternion
from limphome_lab.channels import DECISION, EPISODE, STATE
from limphome_lab.ending import InputError
from limphome_lab.messages import OUTCOMES
from limphome_lab.recording import TornRecording, read_placed
from limphome_lab.robot import apply
from limphome_lab.view.frame import Frame


@dataclass
class Entry:
    """Where an episode lies in the recording."""

    number: int
    ending: episode_t | None  # None: the recording ends before it
    begin: int  # byte of its first state
    end: int  # byte behind its last message


class Recording:
    """`robot`: of limphome_lab.robot, for the centre of mass."""

    def __init__(self, path, robot):
        self.path, self.robot = path, robot
        self.entries = _index(path)
        if not self.entries:
            raise InputError(f"{paths.shown(path)}: holds no states of an episode, so there is nothing to show")

    @property
    def numbers(self):
        return [entry.number for entry in self.entries]

    def episode(self, number=None):
        """The Track of an episode, None: the last that ended, if one has; InputError where that number is not there."""
        if number is None:
            number = next((entry.number for entry in reversed(self.entries) if entry.ending), self.numbers[-1])
        found = [entry for entry in self.entries if entry.number == number]
        if not found:
            raise InputError(
                f"{paths.shown(self.path)}: has no states of episode {number}; it has those of {_told(self.numbers)}"
            )
        return self._track(found[-1])

    def _track(self, entry):
        states, decisions = {}, {}
        for at, channel, data in read_placed(self.path, entry.begin):
            if at > entry.end:
                break
            if channel == STATE:
                state = robot_state_t.decode(data)
                states.setdefault((state.session, state.seq), state)
            elif channel == DECISION:
                decision = decision_t.decode(data)
                decisions.setdefault((decision.session, decision.seq), decision)
        return Track(entry, list(states.values()), decisions, self.robot)


def _index(path):
    """[Entry] of the episodes of which states are left: where a recording was thinned, there may be an ending alone."""
    found = []
    here = 0  # byte before the event
    began = state_at = None  # bytes of the episode's first state and of the newest
    decision = None
    try:
        for at, channel, data in read_placed(path):
            if channel == STATE:
                state_at = here
                began = here if began is None else began
            elif channel == DECISION:
                decision = data
            elif channel == EPISODE:
                ending = episode_t.decode(data)
                if began is not None and began != state_at:
                    found.append(Entry(ending.episode, ending, began, at))
                began = state_at  # where one ends, the next may begin
            here = at
    except TornRecording:
        pass  # a run under way
    if decision and began is not None and began != state_at:
        found.append(Entry(decision_t.decode(decision).episode, None, began, here))
    return found


def _told(numbers):
    """1 to 4, 9, 12 to 20"""
    runs = []
    for number in numbers:
        if runs and number == runs[-1][1] + 1:
            runs[-1][1] = number
        else:
            runs.append([number, number])
    return ", ".join(str(first) if first == last else f"{first} to {last}" for first, last in runs)


class Track:
    """One episode. Times are in s from its begin."""

    def __init__(self, entry, states, decisions, robot):
        self.number, self.ending = entry.number, entry.ending
        self._robot = robot
        states = _of_episode(states, entry)
        self.states = states
        first = states[0].utime
        self.times = np.array([(state.utime - first) / 1e6 for state in states])
        self.decisions = [decisions.get((state.session, state.seq)) for state in states]
        used = states[0].num_actuators
        self._positions = np.array([state.position for state in states])
        self._orientations = np.array([state.orientation for state in states])
        self._actuators = np.array([state.actuator_position[:used] for state in states])
        self._health = np.array([state.actuator_health[:used] for state in states])

    @property
    def duration(self):
        return float(self.times[-1])

    @property
    def outcome(self):
        return OUTCOMES[self.ending.outcome] if self.ending else "under way"

    def at(self, time):
        """The Frame at a time, which is held at the ends."""
        index, share = self._place(time)
        following = min(index + 1, len(self.states) - 1)

        def between(values):
            return values[index] + share * (values[following] - values[index])

        frame = Frame(
            time=self.states[0].utime / 1e6 + self.times[index] + share * (self.times[following] - self.times[index]),
            session=self.states[0].session,
            position=between(self._positions),
            orientation=quaternion.slerp(self._orientations[index], self._orientations[following], share),
            actuator_position=between(self._actuators),
            health=self._health[index],
        )
        frame.centre_of_mass = centre_of_mass(self._robot, frame)
        decision = self.decisions[index]
        frame.margin = decision.stability_margin if decision else None
        return frame

    def trail(self, time):
        """[positions] up to a time."""
        return [*self._positions[: self._place(time)[0] + 1], self.at(time).position]

    def decision(self, time):
        """The decision_t of this episode under way at a time, None where it is not recorded. That on the last state may
        be the next episode's first."""
        index = self._place(time)[0]
        decision = self.decisions[index]
        return self.decisions[index - 1] if decision and decision.episode != self.number else decision

    def _place(self, time):
        """(index of the state before, share of the way to the next)"""
        index = max(bisect_right(self.times, time) - 1, 0)
        if index + 1 == len(self.times):
            return index, 0.0
        step = self.times[index + 1] - self.times[index]
        return index, float(np.clip((time - self.times[index]) / step, 0, 1))


def _of_episode(states, entry):
    """Those of the session and the time of the episode, in order."""
    session = entry.ending.session if entry.ending else states[-1].session
    own = sorted((state for state in states if state.session == session), key=lambda state: state.seq)
    if entry.ending:
        begin = entry.ending.utime - round(entry.ending.duration * 1e6)
        own = [state for state in own if begin <= state.utime <= entry.ending.utime]
    return own


def centre_of_mass(robot, frame):
    """[3] in the world, by the masses of the robot file."""
    placed = robot.frames(frame.actuator_position, frame.position, frame.orientation)
    moments = [body["mass"] * apply(pose, body["centre"]) for body, pose in zip(robot.bodies, placed, strict=True)]
    return sum(moments) / sum(body["mass"] for body in robot.bodies)
