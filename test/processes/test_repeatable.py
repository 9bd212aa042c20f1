"""Same seed, same bytes: over a second run, over an interruption; and another seed, other bytes."""

import signal

from conftest import SMOKE, TIME_LIMIT_S, start_script, train, wait_until
from limphome import checkpoint_t, policy_t
from limphome_lab.runfolder import RunFolder


def policy_after(folder, episode):
    return checkpoint_t.decode((folder.checkpoints / f"episode_{episode:06}.lcm").read_bytes()).policy


def outcome(folder):
    return folder.episodes.read_bytes(), folder.policy.read_bytes()


def test_same_seed_same_bytes(smoke_run, tmp_path):
    train(tmp_path / "again")
    assert outcome(RunFolder(tmp_path / "again")) == outcome(smoke_run)


def test_other_seed_other_bytes(smoke_run, tmp_path):
    train(tmp_path / "other", "--seed", 2, "--episodes", 10)
    other = RunFolder(tmp_path / "other")
    assert other.read_episodes() != smoke_run.read_episodes()[:10]
    assert policy_t.decode(other.policy.read_bytes()).weight != policy_after(smoke_run, 10).weight


def test_runs_side_by_side_do_not_hear_each_other(smoke_run, tmp_path):
    folders = [RunFolder(tmp_path / name) for name in ("one", "two")]
    started = [
        start_script("train", "--config", SMOKE, "--episodes", 10, "--out", folder.path, "--quiet")
        for folder in folders
    ]
    for process in started:
        assert process.wait(TIME_LIMIT_S) == 0, process.communicate()[1]
    for folder in folders:
        assert folder.read_episodes() == smoke_run.read_episodes()[:10]
        assert folder.policy.read_bytes() == policy_after(smoke_run, 10).encode()


def test_resumed_run_ends_as_an_unbroken_one(smoke_run, tmp_path):
    folder = RunFolder(tmp_path / "broken")
    process = start_script("train", "--config", SMOKE, "--out", folder.path, "--quiet")
    # past a checkpoint and some episodes on, so that these must be done again
    wait_until(process, lambda: len(folder.read_episodes()) >= 12)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=TIME_LIMIT_S)
    assert process.returncode == 130
    assert len(folder.read_episodes()) < 30, "it was to be interrupted before its end"
    assert (folder.checkpoints / "episode_000010.lcm").exists()

    resumed = start_script("train", "--resume", folder.path, "--quiet")
    errors = resumed.communicate(timeout=TIME_LIMIT_S)[1]
    assert resumed.returncode == 0, errors
    assert outcome(folder) == outcome(smoke_run)
