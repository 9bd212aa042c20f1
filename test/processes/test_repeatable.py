"""Same seed, same bytes: over a second run, over an interruption; and another seed, other bytes."""

import signal
import time

from conftest import SMOKE, TIME_LIMIT_S, start_script, train

from tools.runfolder import RunFolder


def outcome(folder):
    return folder.episodes.read_bytes(), folder.policy.read_bytes()


def wait_until(process, condition):
    """Waits for `condition()` while `process` runs."""
    deadline = time.monotonic() + TIME_LIMIT_S
    while not condition():
        assert process.poll() is None, process.communicate()[1]
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(0.02)


def test_same_seed_same_bytes(smoke_run, tmp_path):
    train(tmp_path / "again")
    assert outcome(RunFolder(tmp_path / "again")) == outcome(smoke_run)


def test_other_seed_other_bytes(smoke_run, tmp_path):
    train(tmp_path / "other", "--seed", 2, "--episodes", 10)
    other = RunFolder(tmp_path / "other")
    assert other.read_episodes() != smoke_run.read_episodes()[:10]
    assert other.policy.read_bytes() != (smoke_run.checkpoints / "episode_000010.lcm").read_bytes()


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
