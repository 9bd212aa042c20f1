"""Real time: how old what comes over the link may be, what is learned across a gap, and what a reset means."""

import signal
import time
from itertools import pairwise

import pytest
from bus import REAL_TIME, Bus, FakeRobot, controller, inside, simulator

from limphome import reset_request_t, status_t, velocity_command_t
from limphome_lab.channels import COMMAND, DECISION, EPISODE, RESET, STATE
from limphome_lab.messages import TYPES, recorded
from limphome_lab.runfolder import RunFolder

SPEED = 0.3  # of both crawlers' levels [m/s]


def driven(bus, velocity=SPEED):
    """Takes a plant up, arms it and keeps it driving from here on."""
    bus.own()

    def drive(state):
        bus.keep_armed(state)
        bus.command(state, 0.0, velocity)

    bus.answer = drive
    assert bus.until(lambda: bus.state.armed and bus.state.actuator_velocity[1] > 0.1, 10), "it does not move"


def late_commands(folder):
    """The plant is armed and gets nothing but commands that answer states of long ago."""
    with Bus(folder) as bus:
        bus.start(simulator(*REAL_TIME, "link.command_timeout_s=0.3", "link.sender_timeout_s=60"))
        bus.own()
        bus.answer = bus.keep_armed
        assert bus.until(lambda: bus.state.armed, 10)
        delayed = []
        end = time.monotonic() + 3
        while time.monotonic() < end:
            bus.listen(0.05)
            delayed.append((time.monotonic() + 1.0, bus.state))
            while delayed and delayed[0][0] <= time.monotonic():
                bus.command(delayed.pop(0)[1], 0.0, SPEED)
        return {
            "late": bus.status().late,
            "fastest": max(abs(state.actuator_velocity[1]) for state in bus.states),
            "held": sum(state.held for state in bus.states[-10:]),
        }


@pytest.mark.fault(
    "commands that come too late",
    injected="each command a second after the state that it answers, limit 0.3 s",
    expected="none obeyed, each counted, the state tells that the drives were held",
)
def test_the_age_of_a_command_counts_from_the_state_it_answers(tmp_path, observe):
    seen = inside(late_commands, str(tmp_path))
    observe(str(seen))
    assert seen["late"] > 10 and seen["fastest"] < 0.01 and seen["held"] == 10


def fake_real_time(folder, delay_s, seconds=4):
    """A plant in real time whose states arrive at once for a while, then `delay_s` after they were sent."""
    with Bus(folder) as bus:
        robot = FakeRobot(lockstep=0)
        bus.keep = (COMMAND, RESET)
        run = bus.start(controller(f"{folder}/run", *REAL_TIME, "link.command_timeout_s=0.5", "link.give_up_s=0"))
        answered = {}
        begin = time.monotonic()
        while time.monotonic() < begin + seconds:
            late = delay_s if robot.owner and robot.seq >= 10 else 0.0
            bus.say(STATE, robot.state(sent=round((time.monotonic() - late) * 1e6)))
            answered.setdefault(robot.seq, 0)
            bus.listen(0.1)
            for channel, data in bus.heard:
                if channel == RESET and not robot.owner:
                    robot.begin(reset_request_t.decode(data))
                elif channel == COMMAND and robot.owner:
                    answered[velocity_command_t.decode(data).seq] = 1
            bus.heard.clear()
            robot.seq += 1 if robot.owner else 0
        status = bus.status(status_t.CONTROLLER)
        return {
            "at once": sum(answered[seq] for seq in range(1, 10)),
            "delayed": sum(answered[seq] for seq in answered if 10 <= seq < robot.seq - 1),
            "stale": status.stale,
            "impossible": status.rejected_ahead,
            "condition": status.condition,
            "reason": status.reason,
            "words": run.words(),
        }


@pytest.mark.fault(
    "states that come too late",
    injected="states 5 s after they were sent, by the plant's clock; limit 0.5 s",
    expected="none answered, each counted; FAULT with a reason",
)
def test_states_of_long_ago_are_not_acted_on(tmp_path, observe):
    seen = inside(fake_real_time, str(tmp_path), 5.0)
    observe(f"{seen['at once']} answered at once, then {seen['delayed']} answered, {seen['stale']} stale")
    assert seen["at once"] == 9 and seen["delayed"] == 0 and seen["stale"] > 10
    assert (seen["condition"], seen["reason"]) == (status_t.FAULT, status_t.INVALID_STATES)
    assert seen["words"].count("invalid or too old") == 1


@pytest.mark.fault(
    "states from the future",
    injected="states sent 5 s later than now, by the plant's clock",
    expected="none answered, each counted, and they make no true one look old",
)
def test_states_from_the_future_are_inventions(tmp_path, observe):
    seen = inside(fake_real_time, str(tmp_path), -5.0)
    observe(f"{seen['delayed']} answered, {seen['impossible']} refused")
    assert seen["at once"] == 9 and seen["delayed"] == 0 and seen["impossible"] > 10


def stopped(folder, which):
    """One of the two programs is stopped for longer than the plant bears silence, and goes on."""
    with Bus(folder) as bus:
        plant = bus.start(simulator(*REAL_TIME, "link.sender_timeout_s=1", "link.command_timeout_s=0.5"))
        run = bus.start(controller(f"{folder}/run", *REAL_TIME))
        bus.answer = bus.keep_armed
        bus.until(lambda: bus.counts[DECISION] > 10)
        bus.answer = None  # arming is not kept up, so that nothing moves when it goes on
        program = {"plant": plant, "controller": run}[which]
        program.signal(signal.SIGSTOP)
        bus.listen(2)
        program.signal(signal.SIGCONT)
        at = len(bus.states)
        bus.listen(1.5)
        status = bus.status()
        seen = {
            "armed": bus.state.armed,
            "speed": max(max(map(abs, state.actuator_velocity[:5])) for state in bus.states[at + 8 :]),
            "reason": status.reason,
            "sessions": len({state.session for state in bus.states if state.reset_sender}),
        }
        seq = bus.state.seq
        bus.answer = bus.keep_armed
        bus.until(lambda: bus.counts[DECISION] > 20 and bus.state.seq > seq + 20)
        seen["exit"] = run.end()
        return seen


@pytest.mark.parametrize(
    "which, reasons",
    [
        ("plant", (status_t.CONTROLLER_SILENT, status_t.OPERATOR_SILENT)),
        ("controller", (status_t.CONTROLLER_SILENT,)),
    ],
)
@pytest.mark.fault(
    "a process that is stopped in real time",
    injected="SIGSTOP for 2 s, SIGCONT",
    expected="at rest and disarmed; after arming the same session goes on and the step across the gap is not learned",
)
def test_a_stop_disarms_and_is_not_learned_from(tmp_path, which, reasons, observe):
    seen = inside(stopped, str(tmp_path), which)
    decisions = [decision for _, decision in recorded(tmp_path / "run" / "messages.lcmlog", DECISION)]
    across = [b for a, b in pairwise(decisions) if b.seq > a.seq + 1 and b.episode == a.episode]
    observe(f"{seen}; {sum(each.learned for each in across)} of {len(across)} steps across a gap learned")
    assert seen["armed"] == 0 and seen["speed"] < 0.02 and seen["reason"] in reasons and seen["sessions"] == 1
    assert across and not any(each.learned for each in across)
    assert any(each.learned for each in decisions)


def too_fast(folder):
    with Bus(folder) as bus:
        bus.start(simulator(*REAL_TIME, "failure.actuator=none"))
        driven(bus, 4.0)
        bus.listen(1)
        return {
            "fastest": max(abs(state.actuator_velocity[1]) for state in bus.states),
            "limited": bus.status().limited,
        }


@pytest.mark.fault(
    "commands above the speeds that the plant was set up with",
    injected="4 m/s, [action] crawler_speed 0.3 m/s",
    expected="limited to 0.3 m/s and counted",
)
def test_a_plant_limits_what_it_is_commanded(tmp_path, observe):
    seen = inside(too_fast, str(tmp_path))
    observe(str(seen))
    assert seen["fastest"] < 0.4 and seen["limited"] > 5


MISSION = ["task.path=to 0 40", "simulator.reset=where_it_is", "failure.actuator=none"]


def interrupted_mission(folder):
    """A controller is killed on its way and another takes its place."""
    with Bus(folder) as bus:
        bus.start(simulator(*REAL_TIME, *MISSION, "link.sender_timeout_s=0.5"))
        bus.own()
        bus.answer = lambda state: (bus.keep_armed(state), bus.command(state, SPEED, SPEED))
        bus.until(lambda: bus.state.position[1] > 1.0)
        bus.answer = None
        before = bus.state.position
        bus.listen(1.5)
        run = bus.start(controller(f"{folder}/run", *REAL_TIME, *MISSION))
        bus.until(lambda: bus.state.reset_sender not in (0, bus.sender))
        after, reset = bus.state.position, bus.state.reset
        bus.answer = bus.keep_armed
        bus.until(lambda: bus.counts[DECISION] > 10)
        return {"before": before, "after": after, "reset": reset, "exit": run.end()}


@pytest.mark.fault(
    "a controller that dies on its way",
    injected="another one is started 1.5 s later, on a machine that is not carried back",
    expected="the robot stays where it is, and the path goes on from there",
)
def test_a_mission_is_resumed_where_the_robot_stands(tmp_path, observe):
    seen = inside(interrupted_mission, str(tmp_path))
    decisions = [decision for _, decision in recorded(tmp_path / "run" / "messages.lcmlog", DECISION)]
    to_go = decisions[0].waypoint_distance
    observe(f"y {seen['before'][1]:.2f} m before, {seen['after'][1]:.2f} m after; {to_go:.2f} m to go")
    assert seen["reset"] == 1 and seen["after"][1] > 0.9
    assert abs(to_go - (40 - seen["after"][1])) < 0.1
    assert len(RunFolder(tmp_path / "run").read_episodes()) == 0


LYING = [0.5, -0.5, 0.5, 0.5]  # on its side


def tumbled(folder):
    """A robot that cannot be carried back tumbles, lies for 3 s and is righted."""
    with Bus(folder) as bus:
        robot = FakeRobot(lockstep=0)
        bus.keep = (COMMAND, RESET, EPISODE)
        bus.start(controller(f"{folder}/run", *REAL_TIME, "learning.episodes=100"))
        moved, sessions, episodes = [], [], 0
        for n in range(60):
            lying = 15 <= n < 45
            bus.say(STATE, robot.state(reset=1, **({"orientation": LYING} if lying else {})))
            bus.listen(0.1)
            robot.seq += 1
            for channel, data in bus.heard:
                message = TYPES[channel].decode(data)
                if channel == RESET and message.session == robot.session:
                    robot.begin(message)
                    sessions.append(n)
                elif channel == COMMAND and any(message.velocity):
                    moved.append(n)
                elif channel == EPISODE:
                    episodes += 1
            bus.heard.clear()
        told = {(each.condition, each.reason) for each in bus.statuses[status_t.CONTROLLER]}
        return {
            "moved lying": sum(17 <= n < 45 for n in moved),
            "moved righted": sum(n >= 45 for n in moved),
            "sessions": sessions,
            "episodes": episodes,
            "told": (status_t.FAULT, status_t.TUMBLED) in told,
            "words": bus.programs[0].words(),
        }


@pytest.mark.fault(
    "a robot that tumbles and cannot be carried back",
    injected="it lies on its side for 3 s and is then righted",
    expected="one tumble; it is held still, FAULT with the reason, and goes on once it is righted",
)
def test_a_tumbled_robot_lies_until_it_is_righted(tmp_path, observe):
    seen = inside(tumbled, str(tmp_path))
    observe(
        f"{seen['episodes']} episode ended, {len(seen['sessions'])} sessions; then {seen['moved righted']} commands"
    )
    assert seen["moved lying"] == 0 and seen["moved righted"] > 3
    assert seen["episodes"] == 1 and len(seen["sessions"]) == 2
    assert seen["told"] and "until it is righted" in seen["words"]


def test_a_simulator_in_lockstep_can_stay_where_it_is(tmp_path):
    seen = inside(stay, str(tmp_path))
    assert seen["moved"] > 0.05 and abs(seen["left"] - seen["moved"]) < 1e-6


def stay(folder):
    with Bus(folder) as bus:
        bus.start(simulator("simulator.reset=where_it_is", "failure.actuator=none"))
        bus.own()
        for _ in range(3):
            seq = bus.state.seq
            bus.command(bus.state, SPEED, SPEED)
            bus.until(lambda seq=seq: bus.state.seq > seq)
        moved = bus.state.position[1]
        bus.ask_for_reset(bus.state)
        bus.until(lambda: bus.state.seq == 0)
        return {"moved": moved, "left": bus.state.position[1]}
