"""The monitor between learner and wire: sensors that lie, joints that fail, commands that are not safe."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from hazard_plant import AT

from conftest import ROOT, SMOKE, TIME_LIMIT_S
from limphome import decision_t, status_t
from limphome_lab import network, paths
from limphome_lab.channels import COMMAND, DECISION, STATUS
from limphome_lab.messages import recorded
from limphome_lab.runfolder import RunFolder

BOOM = 3  # actuator
LEARNED_AT_MOST = 50  # TD error of honest sensors


def drive(out, hazard, *settings):
    """A few episodes on a plant with that hazard: decisions, commands by (session, seq), last status."""
    prefix = network.private_prefix()
    if prefix is None:
        pytest.skip("network namespaces are not permitted here")
    controller = [paths.program("controller"), "--config", SMOKE, "--robot", ROOT / "config" / "crawler.urdf"]
    controller += ["--out", out, "--lcm-url", network.lcm_url()]
    for setting in ("learning.episodes=3", "episode.reset_every=3", "episode.step_limit=40", *settings):
        controller += ["--set", setting]
    plant = Path(__file__).with_name("hazard_plant.py")
    result = subprocess.run(
        [*prefix, sys.executable, plant, hazard, network.lcm_url(), *map(str, controller)],
        capture_output=True,
        text=True,
        timeout=TIME_LIMIT_S,
    )
    assert result.returncode == 0, result.stderr
    assert result.stdout.strip() == "0", result.stderr
    decisions, commands, status = [], {}, None
    for channel, message in recorded(RunFolder(out).messages, DECISION, COMMAND, STATUS):
        if channel == DECISION:
            decisions.append(message)
        elif channel == COMMAND:
            commands[message.session, message.seq] = list(message.velocity)
        elif message.process == status_t.CONTROLLER:
            status = message
    return decisions, commands, status


def largest_error(decisions):
    return max(abs(decision.td_error) for decision in decisions)


def check_held(decisions, commands, hazard):
    """State AT is answered by standing still, and neither what led there nor what led away was learned."""
    hit = [decision for decision in decisions if decision.seq == AT]
    after = [decision for decision in decisions if decision.seq == AT + 1]
    assert hit and after
    for decision in hit:
        assert decision.interventions == hazard
        assert not any(commands[decision.session, decision.seq])
    assert not any(decision.learned for decision in hit + after)
    assert largest_error(decisions) < LEARNED_AT_MOST
    return f"{len(hit)} states held, none learned, largest TD error {largest_error(decisions):.1f}"


HELD = {
    "position_spike": decision_t.JUMP,
    "joint_jump": decision_t.JUMP,
    "attitude_jump": decision_t.JUMP,
    "invalid_attitude": decision_t.INVALID,
}


@pytest.mark.fault(
    "a sensor that lies for one state",
    injected="a plant whose position is 300 m off, a joint 2 rad off, the attitude upside down, or of no length",
    expected="the robot is held; the step there and the step back are not learned",
)
@pytest.mark.parametrize("hazard", HELD)
def test_a_lie_holds_the_robot_and_is_not_learned(tmp_path, hazard, observe):
    decisions, commands, status = drive(tmp_path / "run", hazard, "safety.monitor=on")
    observe(check_held(decisions, commands, HELD[hazard]))
    assert status.interventions == sum(decision.interventions != 0 for decision in decisions)
    assert status.stilled_actuators == sum(decision.stilled.bit_count() for decision in decisions)


def test_without_the_monitor_a_lie_is_learned(tmp_path):
    decisions, _, _ = drive(tmp_path / "run", "position_spike", "safety.monitor=off")
    assert largest_error(decisions) > 20 * LEARNED_AT_MOST


@pytest.mark.fault(
    "a plant in real time with the monitor off",
    injected="settings say off, the plant says that it does not wait, and its position is 300 m off in one state",
    expected="the monitor is on: the robot is held and the spike not learned",
)
def test_in_real_time_it_cannot_be_switched_off(tmp_path, observe):
    settings = ("safety.monitor=off", "learning.episodes=1", "episode.step_limit=15")
    decisions, commands, _ = drive(tmp_path / "run", "real_time", *settings)
    observe(check_held(decisions, commands, decision_t.JUMP))


@pytest.mark.fault(
    "a body tilted beyond the limit, short of a tumble",
    injected="a plant whose attitude is tilted by 0.95 rad in one state; the limit is set to 0.9",
    expected="the whole robot is stilled there, and learns that it was",
)
def test_a_tilted_robot_is_stilled(tmp_path, observe):
    decisions, commands, _ = drive(tmp_path / "run", "tilt", "safety.monitor=on", "safety.tilt_rad=0.9")
    hit = [decision for decision in decisions if decision.seq == AT]
    for decision in hit:
        assert not any(commands[decision.session, decision.seq])
        assert decision.interventions & decision_t.TILT
        assert decision.action == 40  # all four still
    observe(f"{len(hit)} states, stilled in each")


@pytest.mark.fault(
    "a joint that fails on the way",
    injected="a plant that says so (health FAILED), or whose boom does not move and that says nothing",
    expected="it is commanded no more, and what is learned is of the action without it",
)
@pytest.mark.parametrize("hazard, reason", [("failed_joint", "FAILED"), ("stuck_joint", "STUCK")])
def test_a_failed_joint_is_stilled(tmp_path, hazard, reason, observe):
    decisions, commands, _ = drive(tmp_path / "run", hazard, "safety.monitor=on")
    found = [decision for decision in decisions if decision.interventions & getattr(decision_t, reason)]
    assert found
    first = found[0]
    later = [d for d in decisions if d.session == first.session and d.seq >= first.seq]
    later = [d for d in later if (d.session, d.seq) in commands]  # a reset has none
    assert all(commands[d.session, d.seq][BOOM] == 0 for d in later)
    assert all(d.action // 9 % 3 == 1 for d in later)  # the boom's level is still
    assert all(d.stilled >> BOOM & 1 for d in later if d.proposed_action // 9 % 3 != 1)
    observe(f"found in state {first.seq}, stilled in all {len(later)} from there on")


@pytest.mark.fault(
    "an action that is not safe",
    injected="the library's monitor is given state and action: test_monitor, test_interlock, test_controller",
    expected="what is not safe is stilled, and nothing else",
)
@pytest.mark.parametrize(
    "program, case, test",
    [
        ("monitor", "rules", "no_command_into_a_stop"),
        ("monitor", "rules", "speeds_have_limits_by_kind"),
        ("monitor", "rules", "accelerations_are_from_what_was_executed"),
        ("monitor", "rules", "the_margin_keeps_above_its_floor"),
        ("monitor", "any states", "any_states"),
        ("interlock", "the robot", "any_inputs"),
        ("controller", "decisions", "a_stale_state_holds_the_robot"),
        ("controller", "monitor", "a_place_that_holds_is_believed"),
    ],
    ids=lambda value: value.replace("_", " "),
)
def test_the_library_stills_what_is_not_safe(program, case, test, observe):
    result = subprocess.run(
        [paths.BUILD / "bin" / f"test_{program}"],
        env={**os.environ, "CK_RUN_CASE": case, "CK_TAP_LOG_FILE_NAME": "-"},
        capture_output=True,
        text=True,
    )
    assert result.returncode == 0, result.stdout
    passed = [line for line in result.stdout.splitlines() if line.startswith("ok ") and f":{test}: " in line]
    assert len(passed) == 1
    observe(f"test_{program}: {passed[0].rpartition(': ')[2]}")
