"""Files that were damaged, torn or altered, and folders where another works: told, stepped over or refused, never
silently used."""

import json
import os
import shutil
import signal
import subprocess

import pytest

from conftest import SMOKE, TIME_LIMIT_S, processes_that_mention, run_script, start_script, train, wait_until
from limphome_lab import paths
from limphome_lab.channels import EPISODE
from limphome_lab.messages import recorded
from limphome_lab.runfolder import RunFolder


@pytest.fixture
def run_copy(smoke_run, tmp_path):
    """A run folder of 30 episodes that a test may spoil."""
    shutil.copytree(smoke_run.path, tmp_path / "run", ignore=shutil.ignore_patterns("evaluation"))
    return RunFolder(tmp_path / "run")


def flip_bit(file, bit):
    content = bytearray(file.read_bytes())
    content[bit // 8] ^= 1 << bit % 8
    file.write_bytes(content)


def cut_short(file, octets=1):
    os.truncate(file, file.stat().st_size - octets)


def expect_refused(result, *words):
    assert result.returncode == 2, result.stderr
    assert all(word in result.stderr for word in words), result.stderr
    assert "Traceback" not in result.stderr and len(result.stderr) < 1000


def expect_whole(folder, unbroken):
    assert folder.episodes.read_bytes() == unbroken.episodes.read_bytes()
    assert folder.policy.read_bytes() == unbroken.policy.read_bytes()
    assert [episode.episode for _, episode in recorded(folder.messages, EPISODE)] == list(range(1, 31))


def damage_checkpoint(folder):
    flip_bit(folder.checkpoints / "episode_000030.lcm", 12345)


def cut_checkpoint(folder):
    cut_short(folder.checkpoints / "episode_000030.lcm")


def tear_recording(folder):
    cut_short(folder.messages, 100_000)


def cut_table(folder):
    cut_short(folder.episodes, 10)


@pytest.mark.fault(
    "a file that the newest checkpoint needs is damaged",
    injected="a bit turned, or the end cut off",
    expected="--resume says so, goes on from the checkpoint before and ends as an unbroken run",
)
@pytest.mark.parametrize("damage", [damage_checkpoint, cut_checkpoint, tear_recording, cut_table])
def test_resume_steps_back(smoke_run, run_copy, observe, damage):
    damage(run_copy)
    result = run_script("train", "--resume", run_copy.path, "--quiet", "--no-figures")
    stepped = [line for line in result.stderr.splitlines() if "the checkpoint after episode 30 is stepped over" in line]
    assert len(stepped) == 1
    expect_whole(run_copy, smoke_run)
    observe(stepped[0].replace(str(run_copy.path) + "/", ""))


@pytest.mark.fault(
    "the controller dies between its last checkpoint and its policy",
    injected="policy.lcm removed, --resume",
    expected="the policy is written from the checkpoint, the same bytes",
)
def test_policy_that_was_not_written(smoke_run, run_copy, observe):
    run_copy.policy.unlink()
    run_script("train", "--resume", run_copy.path, "--quiet", "--no-figures")
    expect_whole(run_copy, smoke_run)
    observe("same bytes")


@pytest.mark.fault(
    "all checkpoints are damaged",
    injected="a bit turned in each",
    expected="--resume is refused, and table and recording stay as they are",
)
def test_resume_without_a_good_checkpoint(run_copy, observe):
    for file in run_copy.checkpoints.iterdir():
        flip_bit(file, 4321)
    before = [file.read_bytes() for file in (run_copy.episodes, run_copy.messages)]
    result = run_script("train", "--resume", run_copy.path, "--quiet", check=False)
    expect_refused(result, "holds no checkpoint that is good", "does not match its checksum (damaged)")
    assert [file.read_bytes() for file in (run_copy.episodes, run_copy.messages)] == before
    observe(result.stderr.strip().splitlines()[-1].replace(str(run_copy.path) + "/", ""))


@pytest.mark.fault(
    "a stray file among the checkpoints",
    injected="notes.txt, and names that are nearly right",
    expected="they are ignored",
)
def test_stray_files(smoke_run, run_copy, observe):
    for name in ("notes.txt", "episode_000099.lcm.new", "episode_latest.lcm", "episode_99.lcm"):
        (run_copy.checkpoints / name).write_text("not a checkpoint")
    run_script("train", "--resume", run_copy.path, "--quiet", "--no-figures")
    expect_whole(run_copy, smoke_run)
    run_script("evaluate", run_copy.path, "--episodes", 1, "--average", 2, "--set", "episode.step_limit=20")
    observe("resumed and averaged as without them")


@pytest.mark.fault(
    "a bit of a policy has turned",
    injected="one bit of policy.lcm, at 8 places",
    expected="evaluate refuses it, and the evaluation before stays",
)
def test_damaged_policy(run_copy, observe):
    size = run_copy.policy.stat().st_size
    for bit in range(70, 8 * size, 8 * size // 8):
        flip_bit(run_copy.policy, bit)
        result = run_script("evaluate", run_copy.path, "--episodes", 1, check=False)
        expect_refused(result, "policy.lcm: does not match its checksum (damaged)")
        flip_bit(run_copy.policy, bit)
    assert not (run_copy.path / "evaluation").exists()
    observe("8 of 8 refused")


def test_damaged_checkpoint_is_not_averaged(run_copy):
    flip_bit(run_copy.checkpoints / "episode_000020.lcm", 5000)
    result = run_script("evaluate", run_copy.path, "--average", 2, check=False)
    expect_refused(result, "episode_000020.lcm", "does not match its checksum (damaged)")


@pytest.mark.fault(
    "a recording is torn",
    injected="its end cut off within an event",
    expected="plot and diagnose refuse it, naming file and byte",
)
@pytest.mark.parametrize("command", ["plot", "diagnose"])
def test_torn_recording_is_refused(run_copy, observe, command):
    cut_short(run_copy.messages, 5)
    result = run_script(command, run_copy.path, check=False)
    expect_refused(result, "messages.lcmlog: no whole event at byte ")
    observe(result.stderr.strip().replace(str(run_copy.path) + "/", ""))


@pytest.mark.fault(
    "somebody edited episodes.csv",
    injected="a word in place of a number; another header",
    expected="refused, naming the file and the row",
)
def test_altered_table(run_copy, observe):
    text = run_copy.episodes.read_text()
    run_copy.episodes.write_text(text.replace("timeout,200,", "timeout,many,", 1))
    result = run_script("plot", run_copy.path, check=False)
    expect_refused(result, "episodes.csv", "timeout,many")
    run_copy.episodes.write_text("Episode;" + text)
    expect_refused(run_script("plot", run_copy.path, check=False), "episodes.csv", "header")
    expect_refused(run_script("train", "--resume", run_copy.path, check=False), "episodes.csv:1: is not the header")
    run_copy.episodes.write_bytes(b"\xff\xfe" + text.encode("utf-16-le"))
    expect_refused(run_script("plot", run_copy.path, check=False), "episodes.csv")
    observe(result.stderr.strip().replace(str(run_copy.path) + "/", ""))


@pytest.mark.parametrize("name", ["manifest", "config", "robot"])
def test_altered_inputs_are_refused(run_copy, name):
    getattr(run_copy, name).write_text("{ what is this")
    result = run_script("train", "--resume", run_copy.path, "--quiet", check=False)
    expect_refused(result, getattr(run_copy, name).name)


@pytest.fixture
def running(tmp_path):
    """(process, run folder) of a training run that has finished three episodes."""
    folder = RunFolder(tmp_path / "run")
    process = start_script("train", "--config", SMOKE, "--out", folder.path, "--quiet", "--no-figures")
    wait_until(process, lambda: len(folder.read_episodes()) >= 3)
    yield process, folder
    process.communicate(timeout=TIME_LIMIT_S)


@pytest.mark.fault(
    "a second process works in a run folder",
    injected="train --resume, or a bare limphome-controller, into a run that is going on",
    expected="it is refused, naming the process that is there, and the run ends as if alone",
)
def test_one_process_works_in_a_run_folder(smoke_run, running, observe):
    process, folder = running
    result = run_script("train", "--resume", folder.path, "--quiet", check=False)
    expect_refused(result, f"process {process.pid} works in this folder")
    command = [paths.program("controller"), "--config", folder.config, "--out", folder.path, "--resume"]
    bare = subprocess.run([*command, "--lcm-url", "memq://"], capture_output=True, text=True)
    assert bare.returncode == 2 and "works in this folder" in bare.stderr, bare.stderr
    assert process.wait(TIME_LIMIT_S) == 0
    expect_whole(folder, smoke_run)
    observe("both refused, the run unspoilt")


@pytest.mark.fault(
    "two evaluations of one run at a time",
    injected="evaluate while another evaluates",
    expected="the second is refused and the first ends whole",
)
def test_one_evaluation_at_a_time(run_copy, observe):
    first = start_script("evaluate", run_copy.path, "--episodes", 20)
    rows = RunFolder(run_copy.path / "evaluation")
    wait_until(first, lambda: len(rows.read_episodes()) >= 1)
    second = run_script("evaluate", run_copy.path, "--episodes", 1, check=False)
    expect_refused(second, f"process {first.pid} works in this folder")
    first.communicate(timeout=TIME_LIMIT_S)
    assert first.returncode == 0 and len(rows.read_episodes()) == 20
    observe("second refused, first whole")


@pytest.mark.fault(
    "the script and both programs are killed",
    injected="SIGKILL of the script in the middle of a run; then --resume at once",
    expected="the run ends as an unbroken one, its recording too",
)
def test_killed_run_is_gone_on_with(smoke_run, tmp_path, observe):
    folder = RunFolder(tmp_path / "run")
    process = start_script("train", "--config", SMOKE, "--out", folder.path, "--quiet", "--no-figures")
    wait_until(process, lambda: len(folder.read_episodes()) >= 13)
    programs = [pid for pid in processes_that_mention(folder.path) if pid != process.pid]
    for pid in [process.pid, *programs]:
        os.kill(pid, signal.SIGKILL)
    process.communicate()
    run_script("train", "--resume", folder.path, "--quiet", "--no-figures")
    expect_whole(folder, smoke_run)
    observe("same table and policy, each episode recorded once")


@pytest.mark.fault(
    "a run that would fill the disk",
    injected="[recording] limit_mb = 1, and ten times as many decisions",
    expected="it stays within the limit and what comes between two resets; the manifest tells; the run is the same",
)
def test_recording_is_bounded(smoke_run, tmp_path, observe):
    folder = RunFolder(tmp_path / "run")
    run_script("train", "--config", SMOKE, "--out", folder.path, "--quiet", "--set", "recording.limit_mb=1")
    expect_whole(folder, smoke_run)
    before, after = smoke_run.messages.stat().st_size, folder.messages.stat().st_size
    assert before > 4_000_000 and after < 2_500_000  # it is looked at where the plant is reset, each 1.5 MB
    assert json.loads(folder.manifest.read_text())["recording"] == {"bytes": after, "thinned": True}
    assert json.loads(smoke_run.manifest.read_text())["recording"] == {"bytes": before, "thinned": False}
    assert (folder.path / "controller.log").read_text().count("messages.lcmlog has grown to 1 MB") == 1
    assert (folder.figures / "fig9_motion.png").exists()
    run_script("train", "--resume", folder.path, "--quiet", "--no-figures")
    expect_whole(folder, smoke_run)
    observe(f"{after / 1e6:.1f} MB instead of {before / 1e6:.1f} MB")


@pytest.mark.fault("--resume of an evaluation", injected="RUN/evaluation", expected="refused, and left as it is")
def test_evaluation_is_not_trained_over(run_copy, observe):
    run_script("evaluate", run_copy.path, "--episodes", 1)
    folder = RunFolder(run_copy.path / "evaluation")
    before = folder.episodes.read_bytes()
    result = run_script("train", "--resume", folder.path, check=False)
    expect_refused(result, "is an evaluation")
    assert folder.episodes.read_bytes() == before
    observe("exit code 2")


@pytest.mark.fault(
    "a manifest whose values are of wrong types",
    injected="an object where a list belongs, a part without its times, a text where a number belongs",
    expected="refused before anything runs",
)
@pytest.mark.parametrize("parts", [{}, [{}], [7], [{"wall_time_s": "1"}]], ids=json.dumps)
def test_manifest_of_wrong_types(run_copy, observe, parts):
    run_copy.manifest.write_text(json.dumps({**json.loads(run_copy.manifest.read_text()), "parts": parts}))
    expect_refused(run_script("train", "--resume", run_copy.path, check=False), "is no manifest of a run")
    observe("exit code 2")


@pytest.mark.fault(
    "a script is killed while it makes the run folder",
    injected="a folder with nothing but settings and robot",
    expected="--out takes it",
)
def test_folder_half_made_is_taken(run_copy, tmp_path, observe):
    out = RunFolder(tmp_path / "half")
    out.path.mkdir()
    for file in (run_copy.config, run_copy.robot):
        shutil.copy(file, out.path)
    (out.path / "manifest.json.new").touch()
    train(out.path, "--episodes", 1, "--no-figures")
    assert len(out.read_episodes()) == 1
    observe("trained there")
