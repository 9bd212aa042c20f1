"""The messages of a run: what each channel carries, and the recording."""

from limphome import (
    arm_request_t,
    decision_t,
    episode_t,
    ground_truth_t,
    operate_t,
    pace_t,
    planner_t,
    policy_t,
    pose_t,
    reset_request_t,
    robot_state_t,
    status_t,
    velocity_command_t,
)
from limphome_lab.channels import (
    ARM,
    COMMAND,
    DECISION,
    EPISODE,
    OPERATE,
    PACE,
    PLANNER,
    POLICY,
    POSE,
    RESET,
    STATE,
    STATUS,
    TRUTH,
)
from limphome_lab.recording import read_log

TYPES = {
    STATE: robot_state_t,
    COMMAND: velocity_command_t,
    RESET: reset_request_t,
    ARM: arm_request_t,
    TRUTH: ground_truth_t,
    POSE: pose_t,
    PACE: pace_t,
    OPERATE: operate_t,
    DECISION: decision_t,
    EPISODE: episode_t,
    POLICY: policy_t,
    PLANNER: planner_t,
    STATUS: status_t,
}

OUTCOMES = {episode_t.GOAL: "goal", episode_t.TUMBLE: "tumble", episode_t.TIMEOUT: "timeout"}


def recorded(path, *channels):
    """Yields (channel, message) of the named channels."""
    for channel, data in read_log(path):
        if channel in channels:
            yield channel, TYPES[channel].decode(data)


def episode_states(path, wanted):
    """States of whole episodes from a recording: {episode number: (episode_t, [robot_state_t])} for `wanted`.

    The states run from the start of the episode to its end, each (session, seq) once although a plant repeats
    what is not answered. Episode 0 of `wanted` stands for the first, -1 for the last in the recording.
    """
    found = {}
    last = None
    since_last_episode = []  # encoded; decoded only when they are wanted
    for channel, data in read_log(path):
        if channel == STATE:
            since_last_episode.append(data)
        elif channel == EPISODE:
            episode = episode_t.decode(data)
            last = (episode, since_last_episode)
            if episode.episode in wanted or (0 in wanted and not found.get(0)):
                found[episode.episode if episode.episode in wanted else 0] = last
            # the state in which an episode ended is the one in which the next may start
            since_last_episode = since_last_episode[-1:]
    if -1 in wanted and last:
        found[-1] = last
    return {number: (episode, states_of(episode, states)) for number, (episode, states) in found.items()}


def last_session(path):
    """([episode_t], [robot_state_t]) of the last session in which an episode ended, in order."""
    episodes, states = {}, {}
    for channel, data in read_log(path):
        if channel == STATE:
            state = robot_state_t.decode(data)
            states.setdefault(state.session, {}).setdefault(state.seq, state)
        elif channel == EPISODE:
            episode = episode_t.decode(data)
            episodes.setdefault(episode.session, []).append(episode)
            states = {episode.session: states.get(episode.session, {})}  # the sessions before are not wanted any more
    last = list(episodes)[-1]
    return episodes[last], [state for _, state in sorted(states[last].items())]


def states_of(episode, encoded):
    """The robot_state_t of an episode_t among encoded ones, in order and each once."""
    states = {}
    for data in encoded:
        state = robot_state_t.decode(data)
        if state.session == episode.session:
            states.setdefault(state.seq, state)
    begin = episode.utime - round(episode.duration * 1e6)
    return [state for _, state in sorted(states.items()) if begin <= state.utime <= episode.utime]
