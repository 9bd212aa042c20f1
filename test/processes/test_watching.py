"""Evaluating, launching and spying on real processes."""

import json
import math
import os
import shutil
import signal

import pytest

from conftest import TIME_LIMIT_S, run_script, start_script, wait_until
from limphome import checkpoint_t, policy_t
from limphome_lab import registry
from limphome_lab.channels import DECISION, STATE
from limphome_lab.ending import Ending
from limphome_lab.messages import recorded
from limphome_lab.runfolder import RunFolder
from limphome_lab.sealed import seal


def test_evaluation_is_greedy_and_repeatable(smoke_run):
    policy = smoke_run.policy.read_bytes()
    first = run_script("evaluate", smoke_run.path, "--episodes", 4, "--json").stdout
    rows = RunFolder(smoke_run.path / "evaluation").read_episodes()
    assert run_script("evaluate", smoke_run.path, "--episodes", 4, "--json").stdout == first
    summary = json.loads(first)
    assert summary["episodes"] == len(rows) == 4
    assert summary["goal_share"] == sum(row.outcome == "goal" for row in rows) / 4
    assert smoke_run.policy.read_bytes() == policy, "it was to drive without learning"


def decisions_of_evaluation(run):
    return [decision for _, decision in recorded(run.path / "evaluation" / "messages.lcmlog", DECISION)]


@pytest.mark.parametrize("selection", ["greedy", "boltzmann"])
def test_evaluation_goes_on_where_the_training_ended(smoke_run, selection):
    run_script("evaluate", smoke_run.path, "--episodes", 2, "--selection", selection, "--set", "episode.step_limit=20")
    assert [row.episode for row in RunFolder(smoke_run.path / "evaluation").read_episodes()] == [31, 32]
    decisions = decisions_of_evaluation(smoke_run)
    assert not any(decision.learned for decision in decisions)
    chosen = [decision for decision in decisions if decision.step < 20]  # in the state of the last nothing is chosen
    if selection == "greedy":
        assert all(decision.probability == 1 and decision.q == decision.q_max for decision in chosen)
    else:
        assert any(decision.q < decision.q_max for decision in chosen)
    first = [decision.temperature for decision in chosen if decision.episode == 31]
    assert first == pytest.approx([1 / math.log(31.1)] * len(first), rel=1e-6)


def test_evaluation_of_the_mean_of_the_last_checkpoints(smoke_run):
    run_script("evaluate", smoke_run.path, "--episodes", 1, "--average", 2, "--set", "episode.step_limit=20")
    used = policy_t.decode((smoke_run.path / "evaluation" / "policy.lcm").read_bytes())
    older, newer = (
        checkpoint_t.decode((smoke_run.checkpoints / f"episode_{episode:06}.lcm").read_bytes()).policy
        for episode in (20, 30)
    )
    assert used.episode == 30 and used.speed == newer.speed
    assert used.weight == pytest.approx([(a + b) / 2 for a, b in zip(older.weight, newer.weight, strict=True)])
    assert used.width == pytest.approx([(a + b) / 2 for a, b in zip(older.width, newer.width, strict=True)])
    assert used.centre[0] == pytest.approx([(a + b) / 2 for a, b in zip(older.centre[0], newer.centre[0], strict=True)])
    assert older.weight != newer.weight
    chosen = decisions_of_evaluation(smoke_run)[0]
    assert chosen.q == pytest.approx(value(used, chosen.inputs[: used.num_inputs]), rel=1e-4)


def value(policy, x):
    """Q by (13)(14)."""
    return sum(
        weight * math.exp(-sum((a - b) ** 2 for a, b in zip(x, centre, strict=False)) / width**2)
        for weight, width, centre in zip(policy.weight, policy.width, policy.centre, strict=True)
        if width > 0
    )


def test_evaluation_of_the_mean_of_more_checkpoints_than_there_are_is_refused(smoke_run):
    for count in (0, 4):
        result = run_script("evaluate", smoke_run.path, "--average", count, check=False)
        assert result.returncode == 2 and f"--average {count}: must be from 1" in result.stderr


def test_evaluation_under_other_settings(smoke_run):
    run_script("evaluate", smoke_run.path, "--episodes", 1, "--set", "failure.mode=free")
    assert RunFolder(smoke_run.path / "evaluation").settings()["failure"]["mode"] == "free"


def test_evaluation_under_settings_that_are_refused_leaves_the_earlier_one(smoke_run):
    run_script("evaluate", smoke_run.path, "--episodes", 1)
    before = (smoke_run.path / "evaluation" / "episodes.csv").read_bytes()
    result = run_script("evaluate", smoke_run.path, "--set", "episode.step_limit=0", check=False)
    assert result.returncode == 2 and "from 1 to 100000" in result.stderr
    assert (smoke_run.path / "evaluation" / "episodes.csv").read_bytes() == before


def test_evaluation_beyond_the_last_episode_is_refused(smoke_run, tmp_path):
    shutil.copytree(smoke_run.path, tmp_path / "run")
    copy = RunFolder(tmp_path / "run")
    policy = policy_t.decode(copy.policy.read_bytes())
    policy.episode = 10**9 - 1
    copy.policy.write_bytes(seal(policy))
    result = run_script("evaluate", copy.path, "--episodes", 2, check=False)
    assert result.returncode == 2 and "is of episode 999999999, beyond what can be counted" in result.stderr


def test_evaluation_as_a_table(smoke_run):
    assert "reached the goal" in run_script("evaluate", smoke_run.path, "--episodes", 1).stdout


def test_evaluation_needs_a_policy(tmp_path):
    result = run_script("evaluate", tmp_path, check=False)
    assert result.returncode == 2 and "not a run folder" in result.stderr


def test_evaluation_with_another_robots_policy_is_refused(smoke_run, tmp_path):
    copy = tmp_path / "run"
    shutil.copytree(smoke_run.path, copy)
    config = copy / "config.ini"
    config.write_text(config.read_text().replace("joint_speed = 0.3", "joint_speed = 0.2"))
    result = run_script("evaluate", copy, "--episodes", 1, check=False)
    assert result.returncode == 1
    assert "what was learned is for other actuators, speeds" in result.stderr


def test_launch_tells_of_episodes_until_ctrl_c(launched):
    process, pair = launched
    wait_until(process, lambda: len(RunFolder(pair["run"]).read_episodes()) >= 2)
    process.send_signal(signal.SIGINT)
    output, _ = process.communicate(timeout=TIME_LIMIT_S)
    assert process.returncode == 130
    assert "scripts/spy" in output and "episode 31: timeout after 0.2 s" in output
    assert registry.running() == []


def test_spy_as_text_shows_decoded_values(launched):
    spy = start_script("spy", "--text")
    lines = iter(spy.stdout.readline, "")
    seen = ""
    for line in lines:  # the reader's time limit is that of the whole test run
        seen += line
        if "stability_margin" in seen and f"{STATE}\n" in seen and "orientation" in seen:
            break
    spy.send_signal(signal.SIGINT)
    spy.communicate(timeout=TIME_LIMIT_S)
    assert DECISION in seen and "num_actuators         5" in seen


def test_registry_of_another_user(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    registry.directory()
    monkeypatch.setattr(registry.os, "geteuid", lambda: tmp_path.stat().st_uid + 1)
    with pytest.raises(Ending, match="belongs to another user"):
        registry.directory()


def test_spy_without_a_pair(tmp_path):
    environment = {**os.environ, "XDG_RUNTIME_DIR": str(tmp_path)}
    result = run_script("spy", "--text", check=False, env=environment)
    assert result.returncode == 2 and "nothing is running" in result.stderr
