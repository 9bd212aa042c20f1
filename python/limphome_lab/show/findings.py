"""Why a run does not reach its goals: what can be seen of its last episodes, with numbers and what to try.

Pure functions. Each of FINDINGS looks at an Evidence and gives a Finding, or None where it does not hold.
"""

import math
import statistics
from dataclasses import dataclass
from itertools import pairwise

from limphome_lab.show.learned import GOALS, WINDOW

MOST = 0.5  # share of the episodes from which on they are said to do something
CIRCLING_NET = 0.25  # of the way travelled, at most, between start and end of an episode that circles
CIRCLING_TURNED_RAD = 2 * math.pi  # at least: a full turn, those to the left less those to the right
STANDING_M = 0.10  # farthest from its start in an episode that stands; sensors err by less
EXPLORING_ACTIONS = 3.0  # that are chosen from, in effect; below, little but ties between best ones is left to chance
SATURATED_SHARE = 0.10  # of the drives' time steps at the torque limit; 0.01 where it drives well
TUMBLE_SHARE = 0.10  # of the episodes


@dataclass
class Track:
    """How the robot moved in one episode, from its states."""

    way_m: float  # travelled
    net_m: float  # straight from start to end
    farthest_m: float  # from the start
    turned_rad: float  # to the left, less to the right; beyond pi too
    best_speed_m_s: float  # from one decision to the next
    goal_distance_m: float  # from start to goal line

    @property
    def stands(self):
        return self.farthest_m < STANDING_M and not self.circles

    @property
    def circles(self):
        return abs(self.turned_rad) >= CIRCLING_TURNED_RAD and self.net_m <= CIRCLING_NET * self.way_m


@dataclass
class Evidence:
    """What the findings look at: the last episodes of a run."""

    settings: dict  # {section: {key: text}}
    episodes: list  # runfolder.Episode
    tracks: list  # Track of each of them
    num_actions: float | None = None  # that were chosen from, in effect; None where it does not learn by (3)
    saturated_share: float | None = None  # of the drives' time steps; None where the plant does not tell

    def setting(self, section, key):
        return float(self.settings[section][key])

    @property
    def plans(self):
        return self.settings["learner"]["kind"] == "planner"

    def share(self, outcome):
        return sum(episode.outcome == outcome for episode in self.episodes) / len(self.episodes)

    def median(self, quantity, of=lambda track: True):
        return statistics.median(abs(getattr(track, quantity)) for track in self.tracks if of(track))


@dataclass
class Finding:
    name: str
    text: str  # tells the numbers with their units
    numbers: dict  # by names that end in their units
    advice: list  # what to try: keys and commands


def pose(state):
    """(x [m], y [m], heading [rad]) of a robot_state_t in the world."""
    w, x, y, z = state.orientation
    return state.position[0], state.position[1], math.atan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z))


def track(poses, goal_distance, decision_period):
    """Track of an episode from its poses, one for each decision and one at its end [m, rad, s]."""
    places = [place[:2] for place in poses]
    ways = [math.dist(before, after) for before, after in pairwise(places)]
    turns = [math.remainder(after[2] - before[2], 2 * math.pi) for before, after in pairwise(poses)]
    return Track(
        way_m=sum(ways),
        net_m=math.dist(places[0], places[-1]),
        farthest_m=max(math.dist(places[0], place) for place in places),
        turned_rad=sum(turns),
        best_speed_m_s=max(ways, default=0.0) / decision_period,
        goal_distance_m=goal_distance,
    )


def effective_actions(probabilities):
    """The perplexity of the choices (3): n where all were among n equally probable actions."""
    return math.exp(-statistics.mean(map(math.log, probabilities)))


def saturated_share(statuses, span_s, time_step_s, num_drives):
    """Share of the drives' time steps at the torque limit, over the last `span_s` at least.

    `statuses`: status_t of the plant in order; those before it was started anew do not count. None where it does not
    tell of simulated time, as a real machine does not.
    """
    saturated, until = statuses[-1].saturated, statuses[-1].simulated_time
    before_saturated, since = 0, 0.0
    later = statuses[-1]
    for status in reversed(statuses):
        if status.simulated_time > later.simulated_time:
            break
        if until - status.simulated_time >= span_s:
            before_saturated, since = status.saturated, status.simulated_time
            break
        later = status
    if until <= since:
        return None
    return (saturated - before_saturated) / ((until - since) / time_step_s * num_drives)


def circling(evidence):
    share = statistics.mean(track.circles for track in evidence.tracks)
    if share < MOST:
        return None
    numbers = {
        name: evidence.median(name, lambda track: track.circles) for name in ("way_m", "net_m", "turned_rad")
    } | {"share": share}
    text = (
        f"in {share:.0%} of the episodes, at the median {numbers['way_m']:.1f} m of way end "
        f"{numbers['net_m']:.1f} m from where they began, after {numbers['turned_rad'] / (2 * math.pi):.1f} turns"
    )
    if evidence.plans:
        advice = [f"planner.steering above {evidence.setting('planner', 'steering'):g}"]
    else:
        advice = [f"reward.turn above {evidence.setting('reward', 'turn'):g}", *_better_q_learning(evidence)]
    return Finding("circling", text, numbers, advice)


def standing(evidence):
    share = statistics.mean(track.stands for track in evidence.tracks)
    if share < MOST:
        return None
    farthest = evidence.median("farthest_m", lambda track: track.stands)
    text = f"in {share:.0%} of the episodes, at the median no farther than {farthest:.2f} m from where they began"
    advice = ["other [failure], [second_failure] or [simulator] friction: whether any drive is left that can move it"]
    if evidence.plans:
        advice += [
            f"planner.random_share above {evidence.setting('planner', 'random_share'):g}",
            f"planner.unsafe below {evidence.setting('planner', 'unsafe'):g}",
        ]
    else:
        advice += [f"reward.forward above {evidence.setting('reward', 'forward'):g}", *_better_q_learning(evidence)]
    return Finding("standing", text, {"farthest_m": farthest, "share": share}, advice)


def never_reaching(evidence):
    """It moves, but of WINDOW episodes none reaches the goal, although it is not too far and it does not tumble."""
    explained = standing(evidence) or unreachable_goal(evidence) or evidence.share("tumble") >= MOST
    if len(evidence.episodes) < WINDOW or evidence.share("goal") > 0 or explained:
        return None
    return _short_of_the_goal("never reaching", evidence)


def _short_of_the_goal(name, evidence):
    count = len(evidence.episodes)
    goals = round(evidence.share("goal") * count)
    numbers = {quantity: evidence.median(quantity) for quantity in ("way_m", "farthest_m", "goal_distance_m")}
    text = (
        f"{goals or 'no'} goal{'s' * (goals != 1)} in {count} episodes; at the median {numbers['way_m']:.1f} m of way "
        f"lead no farther than {numbers['farthest_m']:.2f} m from the start; the goal line is "
        f"{numbers['goal_distance_m']:g} m from there"
    )
    advice = [f"learning.episodes above {evidence.settings['learning']['episodes']}"]
    if evidence.plans:
        advice.append(f"planner.random_share above {evidence.setting('planner', 'random_share'):g}")
    else:
        advice += _better_q_learning(evidence)
    return Finding(name, text, numbers | {"episodes": count, "goals": goals}, advice)


def exploration_ended(evidence):
    """T of (4) is so far below the differences of Q that chance has no say any more."""
    if evidence.num_actions is None or evidence.num_actions >= EXPLORING_ACTIONS:
        return None
    numbers = {"temperature": evidence.episodes[-1].temperature, "num_actions": evidence.num_actions}
    text = (
        f"at T = {numbers['temperature']:.3g} of (4) an action is in effect chosen from {numbers['num_actions']:.1f}, "
        f"while {evidence.share('goal'):.0%} of the episodes reach the goal"
    )
    advice = [f"exploration.temperature_floor above {numbers['temperature']:.3g}", *_better_q_learning(evidence)]
    return Finding("exploration ended", text, numbers, advice)


def saturated_drives(evidence):
    share = evidence.saturated_share
    if share is None or share < SATURATED_SHARE:
        return None
    text = f"drives are at their torque limit in {share:.0%} of their time steps"
    advice = [
        f"action.crawler_speed below {evidence.setting('action', 'crawler_speed'):g} m/s",
        f"action.joint_speed below {evidence.setting('action', 'joint_speed'):g} rad/s",
        "--robot with a larger <limit effort>, or failure.weak_factor where a drive is weak",
    ]
    return Finding("saturated drives", text, {"share": share}, advice)


def tumbling(evidence):
    share = evidence.share("tumble")
    if share < TUMBLE_SHARE:
        return None
    text = f"{share:.0%} of the episodes end by a tilt over {evidence.setting('episode', 'tumble_tilt_rad'):.2f} rad"
    if evidence.plans:
        advice = [f"planner.unsafe above {evidence.setting('planner', 'unsafe'):g}"]
    else:
        advice = [
            f"reward.tumble below {evidence.setting('reward', 'tumble'):g}",
            f"reward.stability above {evidence.setting('reward', 'stability'):g}",
        ]
    return Finding("tumbling", text, {"share": share}, advice)


def unreachable_goal(evidence):
    """Even at the best speed of any decision, kept up for a whole episode, the goal line is too far."""
    speed = max(track.best_speed_m_s for track in evidence.tracks)
    distance = min(track.goal_distance_m for track in evidence.tracks)
    period = evidence.setting("episode", "decision_period_s")
    time_limit = evidence.setting("episode", "step_limit") * period
    if evidence.share("goal") > 0 or speed * time_limit >= distance:
        return None
    text = (
        f"the best speed from one decision to the next was {speed:.3f} m/s, with which {time_limit:g} s lead "
        f"{speed * time_limit:.2f} m far, of {distance:g} m to the goal line"
    )
    numbers = {"best_speed_m_s": speed, "time_limit_s": time_limit, "goal_distance_m": distance}
    advice = [f"episode.goal_distance_m below {speed * time_limit:.2f}"]
    if max(track.farthest_m for track in evidence.tracks) >= STANDING_M:
        advice.append(f"episode.step_limit above {distance / speed / period:.0f}")
    return Finding("a goal that cannot be reached", text, numbers, advice)


FINDINGS = (circling, standing, never_reaching, exploration_ended, saturated_drives, tumbling, unreachable_goal)


def findings(evidence):
    """Those that hold, in the order of FINDINGS. Where goals are missed and none of them tells why, that is one."""
    found = [holds for find in FINDINGS if (holds := find(evidence))]
    if not found and evidence.share("goal") < GOALS / WINDOW:
        return [_short_of_the_goal("seldom reaching", evidence)]
    return found


def _better_q_learning(evidence):
    """What made Q-learning learn elsewhere, where these settings do not have it."""
    advice = []
    if evidence.settings["rbf"]["gradient"] == "printed":
        advice.append("rbf.gradient = exact: the printed one rarely learns")
    if evidence.setting("episode", "step_limit") < 2000:
        advice.append("episode.step_limit = 2000: T of (4) falls by the episode, what is learned grows by the decision")
    return [*advice, "--config config/default.ini: a planner"]
