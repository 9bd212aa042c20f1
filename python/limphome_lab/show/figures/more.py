"""Figures that are drawn on demand: of one run by its decisions and by what it learned, of several side by side."""

from types import SimpleNamespace

from limphome_lab import robot
from limphome_lab.messages import DECISION, EPISODE, STATE, decision_t, episode_t, recorded, robot_state_t, states_of
from limphome_lab.recording import read_log
from limphome_lab.runfolder import InputError
from limphome_lab.show import policy
from limphome_lab.show.figures import actions, courses, figures, rewards, save, stretch, values

ENOUGH = 20_000  # decisions of a long run, evenly chosen, tell the use of actions


def draw(folder, out=None, episode=None, value_map=None, paper=False):
    """All figures of a run, into `out` or its figures/. `episode`: number of the one that is drawn by its decisions,
    None: the last; `value_map`: as the user has named two inputs."""
    model = robot.read(folder.robot)
    # what the user may have mistaken comes before what takes long
    learned = None if value_map is None else policy.load(folder, model.actuators)
    chosen = None if value_map is None else policy.chosen(learned, value_map)
    told, states, decisions, evenly = _decided(folder, episode)
    drawn = figures(folder)
    drawn["fig_rewards"] = rewards.draw(
        [SimpleNamespace(letter="", differs={}, runs=[SimpleNamespace(episodes=folder.read_episodes())])]
    )
    drawn["fig_margin"] = stretch.draw(model, told, states, decisions)
    drawn["fig_actions"] = actions.draw(model, _controlled(folder), evenly)
    if learned is not None:
        visited = learned.visited(model.actuators, states, decisions)
        drawn["fig_values"] = values.draw(learned, chosen, visited, model.crawlers, told.episode)
    return save(drawn, out or folder.figures, paper)


def draw_side_by_side(experiments, out, paper=False):
    """`experiments`: of show/experiments.py."""
    return save({"courses": courses.draw(experiments), "rewards": rewards.draw(experiments)}, out, paper)


def _decided(folder, wanted):
    """(episode_t, its states, its decisions, decisions of the whole run evenly chosen)."""
    found, states, decisions = None, [], []
    evenly, stride, count = [], 1, 0
    for channel, data in read_log(folder.messages):
        if channel == STATE:
            states.append(data)
        elif channel == DECISION:
            decisions.append(data)
            if count % stride == 0:
                evenly.append(data)
            count += 1
            if len(evenly) > 2 * ENOUGH:
                evenly, stride = evenly[::2], 2 * stride
        elif channel == EPISODE:
            episode = episode_t.decode(data)
            if wanted in (None, episode.episode):
                found = (episode, states, decisions)
            states, decisions = states[-1:], decisions[-1:]
    if found is None:
        raise InputError(f"--episode {wanted}: is not in {folder.messages}")
    episode, states, decisions = found
    decided = [decision for decision in map(decision_t.decode, decisions) if decision.episode == episode.episode]
    states = states_of(episode, states)
    if len(states) < 2 or len(decided) < 2:
        raise InputError(
            f"{folder.messages}: what episode {episode.episode} consisted of was dropped (recording.limit_mb)"
        )
    return episode, states, decided, [decision_t.decode(data) for data in evenly]


def _controlled(folder):
    """Indices of the actuators that the run drives: those that had not failed when it began."""
    _, first = next(recorded(folder.messages, STATE))
    return [k for k in range(first.num_actuators) if first.actuator_health[k] != robot_state_t.FAILED]
