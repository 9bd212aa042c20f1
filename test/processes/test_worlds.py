"""Other robots, other ground, imperfect sensors and worlds that diverge, through the real processes."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import ROOT, TIME_LIMIT_S, geared_robot, run_script, train
from limphome import policy_t
from limphome_lab import network, paths
from limphome_lab.channels import DECISION, STATE
from limphome_lab.messages import recorded
from limphome_lab.runfolder import RunFolder

SHORT = ["--episodes", 2, "--set", "episode.step_limit=30"]
HARSH = [
    "--set",
    "ground.rough_amplitude_m=0.05",
    "--set",
    "ground.incline_along_rad=0.05",
    "--set",
    "ground.patch_share=0.3",
    "--set",
    "sensors.position_noise=0.01",
    "--set",
    "sensors.joint_bias=0.02",
    "--set",
    "sensors.torque_delay_s=0.1",
    "--set",
    "randomisation.mass=0.1",
    "--set",
    "randomisation.friction=0.2",
    "--set",
    "second_failure.actuator=right_crawler",
    "--set",
    "second_failure.at_episode=3",
    "--set",
    "change.at_episode=3",
    "--set",
    "episode.step_limit=20",
    "--set",
    "episode.reset_every=2",
]


@pytest.mark.parametrize("actuator, actions", [("left_crawler", 3**6), ("none", 3**7)])
def test_two_arms_learn_with_the_same_programs(tmp_path, actuator, actions):
    train(
        tmp_path / "run", "--robot", ROOT / "config" / "two_arm.urdf", *SHORT, "--set", f"failure.actuator={actuator}"
    )
    folder = RunFolder(tmp_path / "run")
    assert len(folder.read_episodes()) == 2
    policy = policy_t.decode(folder.policy.read_bytes())
    assert 3**policy.num_controlled == actions
    assert any(policy.weight), "nothing was learned"
    chosen = {decision.action for _, decision in recorded(folder.messages, DECISION)}
    assert len(chosen) > 30 and actions // 2 < max(chosen) < actions


def test_resumed_run_meets_what_an_unbroken_one_meets(tmp_path):
    train(tmp_path / "unbroken", *HARSH, "--episodes", 4)
    train(tmp_path / "first", *HARSH, "--episodes", 2)
    run_script("train", "--resume", tmp_path / "first", "--episodes", 4, "--quiet")
    unbroken, resumed = RunFolder(tmp_path / "unbroken"), RunFolder(tmp_path / "first")
    assert resumed.episodes.read_bytes() == unbroken.episodes.read_bytes()
    assert resumed.policy.read_bytes() == unbroken.policy.read_bytes()


def test_crawler_that_fails_on_the_way_stays_in_the_network(tmp_path):
    train(tmp_path / "run", *SHORT, "--set", "failure.at_s=5")
    folder = RunFolder(tmp_path / "run")
    assert policy_t.decode(folder.policy.read_bytes()).num_controlled == 5
    health = [(state.utime, state.actuator_health[0]) for _, state in recorded(folder.messages, STATE)]
    assert {failed for utime, failed in health if utime <= 5e6} == {0}
    assert {failed for utime, failed in health if utime > 5e6} == {1}


def drive(tmp_path, velocities):
    """Drives a robot geared beyond reason with a controller of a few lines; returns what that saw."""
    prefix = network.private_prefix()
    if prefix is None:
        pytest.skip("network namespaces are not permitted here")
    robot = geared_robot(tmp_path)
    simulator = [
        paths.program("simulator"),
        "--robot",
        robot,
        "--lcm-url",
        network.lcm_url(),
        "--set",
        "failure.actuator=none",
    ]
    result = subprocess.run(
        [
            *prefix,
            sys.executable,
            Path(__file__).with_name("fault_client.py"),
            network.lcm_url(),
            json.dumps(velocities),
            *map(str, simulator),
        ],
        capture_output=True,
        text=True,
        timeout=TIME_LIMIT_S,
    )
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout), result.stderr


STILL, FAST = [0.0] * 5, [0.0, 0.3, 0.0, 0.0, 0.0]


def test_world_that_diverges_is_reported_and_begun_anew(tmp_path):
    seen, _ = drive(tmp_path, [STILL, STILL, FAST, STILL, STILL, STILL])
    assert seen["all_finite"]
    assert seen["faults"] == 1
    # the session that diverged ends without another state; the next one begins where a robot begins and goes on
    assert [length for _, length in seen["sessions"]] == [3, 4]
    assert seen["fault_session"] == seen["sessions"][0][0]
    assert seen["first_positions"][0] == seen["first_positions"][1]
    assert seen["exit_code"] == 0


def test_world_that_always_diverges_is_given_up(tmp_path):
    seen, words = drive(tmp_path, [FAST] * 20)
    assert seen["all_finite"]
    assert seen["faults"] == 10
    assert seen["exit_code"] == 1
    assert "giving up" in words
