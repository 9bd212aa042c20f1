"""A planner in the processes: what it leaves, how it is gone on with, and for what it may be used."""

import json

import pytest

from conftest import run_script
from limphome import planner_checkpoint_t, planner_t
from limphome_lab.channels import DECISION, PLANNER, POLICY
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
    ("assignment", "exit_code", "reason"),
    [
        ("learner.kind=q_learning", 2, "is of another kind than [learner] kind"),
        ("planner.mechanics=none", 1, "what was learned is for other actuators, speeds, ranges, periods or mechanics"),
        ("episode.decision_period_s=0.25", 1, "what was learned is for other actuators, speeds, ranges, periods"),
    ],
)
def test_evaluation_for_another_purpose_is_refused(run, assignment, exit_code, reason):
    result = run_script("evaluate", run.path, "--episodes", 1, "--set", assignment, check=False)
    assert result.returncode == exit_code and reason in result.stderr


def test_planners_have_no_mean(run):
    result = run_script("evaluate", run.path, "--average", 2, check=False)
    assert result.returncode == 2 and "only networks of Q-learning have a mean" in result.stderr


def test_a_policy_of_q_learning_is_refused_to_a_planner(smoke_run):
    result = run_script("evaluate", smoke_run.path, "--set", "learner.kind=planner", check=False)
    assert result.returncode == 2 and "is of another kind than [learner] kind" in result.stderr
