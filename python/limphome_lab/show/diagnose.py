"""Command diagnose: whether a run learned, and if it did not, what it does instead and what to try."""

import json
import sys
from collections import deque
from dataclasses import asdict

from limphome_lab import command, paths, runfolder
from limphome_lab.ending import with_exit_code
from limphome_lab.show import learned
from limphome_lab.show.findings import Evidence, effective_actions, findings, pose, saturated_share, track

CRITERION = {  # of a window's medians: (what a person reads, the most)
    "duration_s": ("{:.1f} s", learned.DURATION_S),
    "lateral_error_m": ("{:.2f} m beside the line", learned.LATERAL_ERROR_M),
    "heading_change_rad": ("{:.2f} rad of turn", learned.HEADING_CHANGE_RAD),
}


def reaches_its_goals(episodes):
    """Whether the last episodes do: then there is nothing to find."""
    end = episodes[-learned.WINDOW :]
    return sum(episode.outcome == "goal" for episode in end) >= learned.GOALS / learned.WINDOW * len(end)


def read_evidence(folder, episodes):
    """Evidence of the last episodes of a run."""
    # lcm is there once all is set up, and --help before
    from limphome_lab.messages import DECISION, TYPES, states_of

    ended, statuses = _recorded_end(folder, episodes)
    if not ended:
        raise runfolder.InputError(f"{folder.messages}: holds no episode that has ended")
    settings = {section: dict(keys) for section, keys in folder.settings().items()}
    end = episodes[-learned.WINDOW :]
    of_episode = [(episode, states_of(episode, encoded)) for episode, encoded, _ in ended]
    of_episode = [(episode, states) for episode, states in of_episode if len(states) > 1]  # recording.limit_mb
    if not of_episode:
        raise runfolder.InputError(f"{folder.messages}: holds no episode that has ended with its states")
    period = float(settings["episode"]["decision_period_s"])
    evidence = Evidence(settings, end, [_track(episode, states, period) for episode, states in of_episode])
    if settings["learner"]["kind"] == "q_learning":
        evidence.num_actions = _num_actions(TYPES[DECISION].decode(data) for _, _, encoded in ended for data in encoded)
    plant = [status for status in statuses if status.process == status.PLANT]
    if plant:
        evidence.saturated_share = saturated_share(
            plant,
            sum(episode.duration_s for episode in end),
            float(settings["simulator"]["time_step_s"]),
            of_episode[-1][1][-1].num_actuators,
        )
    return evidence


def _recorded_end(folder, episodes):
    """What _recorded gives of the last episodes, for which the end of a long recording is enough."""
    size = folder.messages.stat().st_size
    steps = [episode.steps for episode in episodes]
    # twice what the decisions tell, as other messages lie unevenly; one episode more, whose last state is needed
    length = round(2 * size * sum(steps[-learned.WINDOW - 1 :]) / sum(steps))
    ended, statuses = _recorded(folder.messages, max(0, size - length))
    if length < size and len(ended) <= learned.WINDOW:
        ended, statuses = _recorded(folder.messages, 0)
    return list(ended)[-learned.WINDOW :], statuses


def _recorded(path, begin):
    """([(episode_t, states, decisions)], [status_t]) from byte `begin` of a recording on: of one episode more than the
    last ones, the first of which may have begun before, with states and decisions encoded."""
    from limphome_lab.messages import DECISION, EPISODE, STATE, STATUS, TYPES
    from limphome_lab.recording import read_log

    ended = deque(maxlen=learned.WINDOW + 1)
    statuses, states, decisions = [], [], []
    for channel, data in read_log(path, begin):
        if channel == STATE:
            states.append(data)
        elif channel == DECISION:
            decisions.append(data)
        elif channel == STATUS:
            statuses.append(TYPES[STATUS].decode(data))
        elif channel == EPISODE:
            ended.append((TYPES[EPISODE].decode(data), states, decisions))
            # the state in which an episode ended is the one in which the next may start
            states, decisions = states[-1:], []
    return ended, statuses


def _track(episode, states, period):
    return track([pose(state) for state in states], episode.goal_distance, period)


def _num_actions(decisions):
    """In effect, of those that learned; None in an evaluation, where none does."""
    # where a reset is asked for nothing is chosen and the probability is 0
    probabilities = [decision.probability for decision in decisions if decision.learned and decision.probability > 0]
    return effective_actions(probabilities) if probabilities else None


def diagnose(folder):
    """What is known of a run in which an episode has ended, as JSON would have it."""
    episodes = folder.read_episodes()
    end = episodes[-learned.WINDOW :]
    n = learned.learned_at(episodes)
    found = [] if reaches_its_goals(episodes) else findings(read_evidence(folder, episodes))
    return {
        "episodes": len(episodes),
        "learned_at": n,
        "held": learned.held(episodes),
        "robot_minutes": learned.robot_minutes(episodes),
        "last": {
            "episodes": len(end),
            "goals": sum(episode.outcome == "goal" for episode in end),
            "tumbles": sum(episode.outcome == "tumble" for episode in end),
            **{quantity: learned.median_size(end, quantity) for quantity in CRITERION},
        },
        "findings": [asdict(finding) for finding in found],
    }


def verdict(diagnosis):
    """In a line: when it learned, and of its last episodes."""
    n, last = diagnosis["learned_at"], diagnosis["last"]
    if n is not None:
        when = f"learned at {n} ({diagnosis['robot_minutes']:.1f} robot minutes), held in {diagnosis['held']:.0%} since"
    elif diagnosis["episodes"] < learned.WINDOW:
        when = f"{diagnosis['episodes']} episodes are too few to tell whether it learned; {learned.WINDOW} do"
    elif last["goals"] >= learned.GOALS:
        when = "reaches its goals, but what is marked below keeps that from counting as learned"
    else:
        when = "not learned"
    tumbled = " (at most 0)" if last["tumbles"] else ""
    parts = [f"{last['goals']} goals", f"{last['tumbles']} tumbles{tumbled}"]
    for quantity, (words, most) in CRITERION.items():
        missed = f" (at most {most:.2g})" if last[quantity] > most else ""
        parts.append(words.format(last[quantity]) + missed)
    return f"{when}\nlast {last['episodes']} episodes: {', '.join(parts)}"


def text(diagnosis):
    blocks = [verdict(diagnosis)]
    for finding in diagnosis["findings"]:
        advice = "".join(f"\n    try {words}" for words in finding["advice"])
        blocks.append(f"{finding['name']}: {finding['text']}{advice}")
    return "\n\n".join(blocks)


def in_a_line(folder):
    """What is to be said at the end of a training that does not reach its goals; None of one that does."""
    episodes = folder.read_episodes()
    if not episodes or reaches_its_goals(episodes):
        return None
    diagnosis = diagnose(folder)
    last = diagnosis["last"]
    names = ", ".join(finding["name"] for finding in diagnosis["findings"])
    return (
        f"{last['goals']} of the last {last['episodes']} episodes reached the goal{names and ': ' + names}; "
        f"{command.called('diagnose')} {paths.shown(folder.path)} tells more"
    )


@with_exit_code
def main():
    parser = command.parser(
        "diagnose",
        "Tells whether a run learned, and if it did not, what it does instead and what to try.",
        "runs/default-seed1-20250131-120000",
    )
    parser.add_argument("run", metavar="RUN", help="run folder, of a training or an evaluation")
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
    args = parser.parse_args()
    folder = runfolder.existing(args.run, "episodes", "messages")
    if not folder.read_episodes():
        raise runfolder.InputError(f"{args.run}: no episode has ended, so there is nothing to tell")
    diagnosis = diagnose(folder)
    print(json.dumps(diagnosis, indent=2) if args.json else text(diagnosis))
    return 0


if __name__ == "__main__":
    sys.exit(main())
