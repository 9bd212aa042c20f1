"""A planner in the processes: what it leaves, how it is gone on with, and for what it may be used."""

import json
import shutil

import pytest

from conftest import ROOT, run_script
from limphome import planner_checkpoint_t, planner_t
from limphome_lab.channels import DECISION, PLANNER, POLICY, STATE
from limphome_lab.messages import recorded
from limphome_lab.runfolder import RunFolder

EPISODES, RESET_EVERY = 30, 10


def train(out, *arguments):
    """Of no other configuration than the one there is without --config."""
    run_script("train", "--set", f"episode.reset_every={RESET_EVERY}", "--out", out, "--quiet", *arguments)
    return RunFolder(out)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Run folder of 30 episodes, seed 1."""
    return train(tmp_path_factory.mktemp("planner") / "run", "--episodes", EPISODES)


def outcome(folder):
    return folder.episodes.read_bytes(), folder.policy.read_bytes()


def test_training_without_a_config_is_that_of_a_planner(run):
    assert json.loads(run.manifest.read_text())["config"] == "default"
    assert run.settings()["learner"]["kind"] == "planner"
    assert planner_t.decode(run.policy.read_bytes()).num_samples > 100


def test_it_learns(run):
    assert all(row.outcome == "goal" for row in run.read_episodes()[-10:])


def test_resumed_run_ends_as_an_unbroken_one(run, tmp_path):
    broken = train(tmp_path / "broken", "--episodes", 20)
    assert outcome(broken) != outcome(run)
    run_script("train", "--resume", broken.path, "--episodes", EPISODES, "--quiet")
    assert outcome(broken) == outcome(run)


def test_other_seed_other_bytes(run, tmp_path):
    other = train(tmp_path / "other", "--seed", 2, "--episodes", 10)
    assert other.read_episodes() != run.read_episodes()[:10]


def test_policy_is_the_last_message_and_each_checkpoint_was_told(run):
    told = [message.encode() for _, message in recorded(run.messages, PLANNER)]
    assert run.policy.read_bytes() == told[-1]
    assert list(recorded(run.messages, POLICY)) == []
    files = sorted(run.checkpoints.iterdir())
    assert [file.name for file in files] == [f"episode_{number:06}.lcm" for number in (10, 20, 30)]
    for file in files:
        checkpoint = planner_checkpoint_t.decode(file.read_bytes())
        assert file.name == f"episode_{checkpoint.episode:06}.lcm"
        assert checkpoint.planner.encode() in told


@pytest.mark.parametrize("selection", ["greedy", "boltzmann"])
def test_evaluation_drives_without_learning(run, selection):
    policy = run.policy.read_bytes()
    arguments = ("evaluate", run.path, "--episodes", 3, "--selection", selection, "--json")
    first = run_script(*arguments).stdout
    assert run_script(*arguments).stdout == first
    summary = json.loads(first)
    assert summary["episodes"] == 3 and summary["goal_share"] == 1
    assert run.policy.read_bytes() == policy
    evaluation = RunFolder(run.path / "evaluation")
    assert [row.episode for row in evaluation.read_episodes()] == [31, 32, 33]
    assert not any(decision.learned for _, decision in recorded(evaluation.messages, DECISION))


@pytest.mark.parametrize(
    ("assignment", "reason"),
    [
        ("learner.kind=q_learning", "learner.kind = q_learning: {name} has learned with planner"),
        ("planner.mechanics=none", "planner.mechanics = none: {name} has learned with quasi_static"),
        ("episode.decision_period_s=0.25", "episode.decision_period_s = 0.25: {name} has learned with 0.5"),
        ("action.joint_speed=0.2", "action.joint_speed = 0.2: {name} has learned with 0.3"),
        ("failure.actuator=right_crawler", "{name} has learned to do without left_crawler"),
        ("failure.at_s=5", "no actuator cannot be driven"),
    ],
)
def test_evaluation_for_another_purpose_is_refused(run, assignment, reason):
    result = run_script("evaluate", run.path, "--episodes", 1, "--set", assignment, check=False)
    assert result.returncode == 2 and reason.format(name=run.path.name) in result.stderr


@pytest.mark.parametrize("change", [("quasi_static", "none"), ("decision_period_s = 0.5", "decision_period_s = 0.25")])
def test_the_controller_itself_refuses_what_is_for_another_purpose(run, tmp_path, change):
    copy = tmp_path / "run"
    shutil.copytree(run.path, copy)
    config = copy / "config.ini"
    config.write_text(config.read_text().replace(*change))
    result = run_script("evaluate", copy, "--episodes", 1, check=False)
    assert result.returncode == 1
    assert "what was learned is for other actuators, speeds, ranges, periods or mechanics" in result.stderr


def evaluated(run, *arguments):
    return json.loads(run_script("evaluate", *run, *arguments, "--json").stdout)


def test_greedy_episodes_begin_from_poses_of_their_own(run):
    summary = evaluated([run.path], "--episodes", 4)
    messages = RunFolder(run.path / "evaluation").messages
    first = {state.actuator_position for _, state in recorded(messages, STATE) if state.seq == 0}
    assert len(first) >= 4  # and one before the controller has asked for any
    assert evaluated([run.path], "--episodes", 4, "--seed", 9) != summary
    assert evaluated([run.path], "--episodes", 4) == summary


def test_one_pose_can_be_asked_for(run):
    evaluated([run.path], "--episodes", 2, "--set", "randomisation.joint_rad=0")
    settings = RunFolder(run.path / "evaluation").settings()
    assert (
        settings["episode"]["reset_every"] == str(RESET_EVERY) and float(settings["randomisation"]["position_m"]) == 0
    )


def test_an_evaluation_takes_another_world_but_not_another_learner(run):
    evaluated([run.path], "--episodes", 2, "--config", ROOT / "config" / "rough.ini")
    settings = RunFolder(run.path / "evaluation").settings()
    assert settings["ground"]["rough_amplitude_m"] == "0.08" and settings["learner"]["kind"] == "planner"


def test_several_runs_are_evaluated_one_after_the_other(run, smoke_run):
    first, second = evaluated([run.path, smoke_run.path], "--episodes", 2, "--set", "episode.step_limit=50")
    assert first["run"] == str(run.path) and second["run"] == str(smoke_run.path)
    result = run_script("evaluate", run.path, smoke_run.path, "--out", run.path / "one", check=False)
    assert result.returncode == 2 and "--out is for one RUN" in result.stderr


def test_planners_have_no_mean(run):
    result = run_script("evaluate", run.path, "--average", 2, check=False)
    assert result.returncode == 2 and "only networks of Q-learning have a mean" in result.stderr


def test_a_policy_of_q_learning_is_refused_to_a_planner(smoke_run):
    result = run_script("evaluate", smoke_run.path, "--set", "learner.kind=planner", check=False)
    assert result.returncode == 2 and "has learned with q_learning" in result.stderr
