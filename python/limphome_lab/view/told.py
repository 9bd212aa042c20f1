"""What the messages of a pair tell, in words and as tables in Markdown."""

import numpy as np

from limphome import decision_t, pose_t, robot_state_t, status_t
from limphome_lab.messages import OUTCOMES

LEVELS = ("reverse", "still", "forward")  # of a joint action, as in decision_t
SIGNS = dict(zip(LEVELS, ("◀", "·", "▶"), strict=True))
INTERVENTIONS = (
    *("INVALID", "STALE", "JUMP", "TILT", "MARGIN", "SPEED"),
    *("ACCELERATION", "STOP", "FAILED", "STUCK", "COLLISION"),
)
HEALTH = {robot_state_t.FAILED: "failed", robot_state_t.WEAK: "weak"}
COUNTERS = {  # of status_t, where they are not 0; shown always: those of ALWAYS
    "decisions": "decisions",
    "episodes": "episodes",
    "interventions": "interventions of the monitor",
    "stilled_actuators": "actuators that it stilled",
    "clamped": "held back by limits",
    "limited": "commands above their limit",
    "saturated": "steps of drives at their torque limit",
    "faults": "simulations that diverged",
    "resent": "sent again",
    "duplicates": "duplicates",
    "late": "commands too old",
    "stale": "states too old",
    "rejected_malformed": "malformed",
    "rejected_non_finite": "not finite",
    "rejected_session": "of another session",
    "rejected_sender": "of another sender",
    "overruns": "floods",
}
ALWAYS = ("decisions", "episodes", "interventions", "stilled_actuators", "clamped")
PROCESSES = {status_t.PLANT: "plant", status_t.CONTROLLER: "controller"}
CONDITIONS = {
    status_t.WAITING: "waiting",
    status_t.RUNNING: "running",
    status_t.FINISHED: "finished",
    status_t.FAULT: "fault",
    status_t.DEGRADED: "degraded",
}


def levels(robot, decision, health):
    """{actuator: one of LEVELS} of the executed joint action; what is not controlled is not in it. None where which are
    controlled cannot be told: something has failed since the run began."""
    count = (decision.num_inputs - 2) // 2
    controlled = [k for k in range(len(robot.actuators)) if health[k] != robot_state_t.FAILED]
    if count == len(robot.actuators):
        controlled = list(range(count))
    if count != len(controlled):
        return None
    return {robot.actuators[k]: LEVELS[decision.action // 3**place % 3] for place, k in enumerate(controlled)}


def decision_table(robot, decision, health):
    """The action, an actuator a line."""
    chosen = levels(robot, decision, health)
    lines = ["| actuator | does |", "|:--|:--|"]
    for index, name in enumerate(robot.actuators):
        does = "?" if chosen is None else chosen.get(name, "")
        words = [f"{SIGNS[does]} {does}"] if does in SIGNS else [does] if does else []
        if decision.stilled >> index & 1:
            words.append("**stilled by the monitor**")
        if health[index] in HEALTH:
            words.append(f"**{HEALTH[health[index]]}**")
        lines.append(f"| {spoken(name)} | {', '.join(words)} |")
    return "\n".join(lines)


def figures(decision):
    """Of a decision, in lines of two."""
    reasons = [spoken(name.lower()) for name in INTERVENTIONS if decision.interventions & getattr(decision_t, name)]
    told = [
        ("Q of the action", f"{decision.q:.3f}"),
        ("best Q", f"{decision.q_max:.3f}"),
        ("probability", f"{decision.probability:.3f}"),
        ("temperature", f"{decision.temperature:.3g}"),
        ("TD error", f"{decision.td_error:.3f}" if decision.learned else "-"),
        ("stability margin", f"{decision.stability_margin:.3f} m"),
        ("to the goal line", f"{decision.goal_distance:.2f} m"),
        ("beside the line", f"{decision.lateral_error:+.2f} m"),
        ("off its direction", f"{np.degrees(decision.heading_error):+.1f}°"),
        ("monitor", ", ".join(reasons) or "-"),
    ]
    return table(("decision", ""), told)


def episodes(now, ended):
    """`now`: (episode, step) under way, or None; `ended`: rows of episodes.csv, or Episode alike."""
    lines = []
    if now is not None:
        lines.append(f"**Episode {now[0]}**, decision {now[1]}")
    if ended:
        last = ended[-1]
        lines.append(
            f"Last: **{last.outcome}** after {last.duration_s:.1f} s, "
            f"{abs(last.lateral_error_m):.2f} m beside the line, reward {last.reward:.2f}"
        )
        recent = ended[-20:]
        goals = sum(each.outcome == "goal" for each in recent)
        lines.append(f"Of the last {len(recent)} episodes {goals} reached the goal")
    return "\n\n".join(lines)


def pace(value):
    if value == pose_t.PACE_FREE:
        return "as fast as it can"
    return "paused" if value == 0 else f"{value:g} times real time"


def counters(statuses):
    """`statuses`: {process: newest status_t}"""
    known = [statuses[process] for process in PROCESSES if process in statuses]
    if not known:
        return "nothing heard yet"
    lines = [("", *(f"**{PROCESSES[each.process]}**" for each in known))]
    lines.append(("condition", *(CONDITIONS.get(each.condition, "?") for each in known)))
    for field, words in COUNTERS.items():
        values = [getattr(each, field) for each in known]
        if field in ALWAYS or any(values):
            lines.append((words, *(f"{value:,}".replace(",", "\u202f") for value in values)))
    return table(lines[0], lines[1:])


def table(head, rows):
    lines = [head, (":--", *["--:"] * (len(head) - 1)), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def outcome(episode):
    """Of an episode_t."""
    return OUTCOMES.get(episode.outcome, "?")


def spoken(name):
    return name.replace("_", " ")
