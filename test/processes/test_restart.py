"""Whatever dies, and in whichever order, a run ends as one that nothing happened to."""

import json
import os
import random
import shutil
import signal
import time

import pytest

from conftest import SMOKE, TIME_LIMIT_S, processes_that_mention, run_script, start_script, train, wait_until
from limphome_lab.channels import EPISODE
from limphome_lab.messages import recorded
from limphome_lab.run.pair import how_it_ended
from limphome_lab.runfolder import RunFolder

KILLS = int(os.environ.get("LIMPHOME_KILLS", "20"))
# of a plant that has lost its controller, and the other way round; short, as each kill waits for it
HASTE = ("--set", "link.sender_timeout_s=0.2")
SHORT = ("--episodes", 100, "--set", "episode.step_limit=40", "--no-figures", "--quiet")
OFTEN = ("--set", "episode.reset_every=5")


def program_of(folder, name):
    """Process id of one of the two programs of a run; None where it does not run."""
    for pid in processes_that_mention(folder.path):
        try:
            with open(f"/proc/{pid}/comm") as comm:
                if comm.read().strip() == f"limphome-{name}"[:15]:
                    return pid
        except FileNotFoundError:
            continue
    return None


def kill(folder, name):
    """Whether there was such a program to be killed."""
    pid = program_of(folder, name)
    if pid is not None:
        os.kill(pid, signal.SIGKILL)
    return pid is not None


@pytest.fixture(scope="module")
def unbroken(tmp_path_factory):
    folder = RunFolder(tmp_path_factory.mktemp("unbroken") / "run")
    train(folder.path, *SHORT)
    return folder


@pytest.fixture
def supervised(tmp_path):
    """(process, run folder) of a run that is supervised."""
    folder = RunFolder(tmp_path / "run")
    process = start_script("train", "--config", SMOKE, "--out", folder.path, "--supervise", *SHORT, *HASTE)
    yield process, folder
    if process.poll() is None:
        process.kill()
    process.communicate()


def expect_unbroken(process, folder, unbroken):
    """The run ends as `unbroken` did; returns the restarts that its manifest tells of."""
    errors = process.communicate(timeout=TIME_LIMIT_S)[1]
    assert process.returncode == 0, errors
    assert folder.episodes.read_bytes() == unbroken.episodes.read_bytes()
    assert folder.policy.read_bytes() == unbroken.policy.read_bytes()
    rows = [row.episode for row in folder.read_episodes()]
    assert [episode.episode for _, episode in recorded(folder.messages, EPISODE)] == rows
    return json.loads(folder.manifest.read_text())["parts"][-1].get("restarts", [])


@pytest.mark.fault(
    "a program dies in the middle of a run",
    injected="SIGKILL; train --supervise",
    expected="it is started again, and the run ends byte for byte as an unbroken one",
)
@pytest.mark.parametrize("names", [["simulator"], ["controller"], ["simulator", "controller"]], ids="+".join)
def test_program_that_dies_is_started_again(unbroken, supervised, observe, names):
    process, folder = supervised
    wait_until(process, lambda: len(folder.read_episodes()) >= 13)
    killed = [kill(folder, name) for name in names]
    assert all(killed)
    restarts = expect_unbroken(process, folder, unbroken)
    assert sorted(restart["process"] for restart in restarts) == sorted(names)
    observe(f"{len(restarts)} restarts, same table and policy")


@pytest.mark.fault(
    "a program that dies has done much by then",
    injected="SIGKILL late in a run; train --supervise",
    expected="the manifest counts the decisions of all its lives, but for those after the last status before its death",
)
def test_manifest_sums_the_lives_of_a_process(tmp_path, observe):
    folder = RunFolder(tmp_path / "run")
    options = (*SHORT, *OFTEN, *HASTE)
    process = start_script("train", "--config", SMOKE, "--out", folder.path, "--supervise", *options)
    wait_until(process, lambda: len(folder.read_episodes()) >= 70)
    steps = sum(row.steps for row in folder.read_episodes())
    assert kill(folder, "controller")
    assert process.wait(TIME_LIMIT_S) == 0, process.communicate()[1]
    manifest = json.loads(folder.manifest.read_text())
    restart = manifest["parts"][0]["restarts"][0]
    measured = 1 - restart["unmeasured_s"] / manifest["wall_time_s"]
    observe(
        f"{manifest['decisions']} decisions, {steps} steps before the kill, {restart['unmeasured_s']} s not measured"
    )
    assert 0 < restart["unmeasured_s"] < 3
    assert manifest["decisions"] >= steps * measured * 0.7


@pytest.mark.fault(
    "the controller dies before the first checkpoint",
    injected="SIGKILL; train --supervise",
    expected="it begins anew, and the run ends byte for byte as an unbroken one",
)
def test_controller_that_dies_before_the_first_checkpoint(unbroken, supervised, observe):
    process, folder = supervised
    wait_until(process, lambda: len(folder.read_episodes()) >= 2)
    assert kill(folder, "controller")
    assert len(expect_unbroken(process, folder, unbroken)) == 1
    observe("same table and policy")


def test_signals_without_a_name_are_told_by_number():
    assert how_it_ended(-signal.SIGKILL) == "signal SIGKILL"
    assert how_it_ended(-40) == "signal 40"
    assert how_it_ended(3) == "exit code 3"


@pytest.mark.fault(
    "programs die all the time",
    injected=f"{KILLS} SIGKILLs at random; train --supervise",
    expected="the run ends byte for byte as an unbroken one",
)
def test_many_kills(tmp_path, observe):
    unbroken = RunFolder(tmp_path / "unbroken")
    train(unbroken.path, *SHORT, *OFTEN)
    draw = random.Random(1)
    kills, runs = 0, 0
    while kills < KILLS:
        folder = RunFolder(tmp_path / f"run{runs}")
        options = ("--config", SMOKE, "--out", folder.path, "--supervise", *SHORT, *OFTEN, *HASTE)
        process = start_script("train", *options)
        kills_here = kill_at_random(process, folder, draw, KILLS - kills)
        restarts = expect_unbroken(process, folder, unbroken)
        assert kills_here - 1 <= len(restarts) <= kills_here  # the last may come after the end
        shutil.rmtree(folder.path)
        kills += kills_here
        runs += 1
    observe(f"{kills} kills in {runs} runs, same table and policy in all")


def kill_at_random(process, folder, draw, most):
    """Kills either program after some time and some episodes more, again and again; returns how often."""
    kills = 0
    while kills < most:
        time.sleep(draw.uniform(0, 0.3))
        rows = len(folder.read_episodes()) + draw.randint(0, 25)
        while process.poll() is None and len(folder.read_episodes()) < rows:
            time.sleep(0.01)
        if process.poll() is not None:
            break
        kills += kill(folder, draw.choice(["simulator", "controller"]))
    return kills


@pytest.mark.fault(
    "a program dies again and again",
    injected="SIGKILL of each new controller; train --supervise",
    expected="the run gives up, tells why and ends with an exit code other than 0",
)
def test_supervision_gives_up(supervised, observe):
    process, folder = supervised
    while process.poll() is None:
        kill(folder, "controller")
        time.sleep(0.02)
    errors = process.communicate()[1]
    assert process.returncode == 1
    assert errors.count("is started again") == 10 and "limphome-controller ended early (signal SIGKILL)" in errors
    assert "Traceback" not in errors
    assert processes_that_mention(folder.path) == []
    observe("gave up after 10 restarts, exit code 1")


@pytest.mark.fault(
    "the plant hangs until the controller gives up",
    injected="SIGSTOP of the simulator, link.give_up_s=1; train --supervise",
    expected="the run ends at once, without a restart, and names the process that is stuck",
)
def test_controller_that_gives_up_is_not_started_again(tmp_path, observe):
    folder = RunFolder(tmp_path / "run")
    options = (*SHORT, *HASTE, "--set", "link.give_up_s=1", "--supervise")
    process = start_script("train", "--config", SMOKE, "--out", folder.path, *options)
    wait_until(process, lambda: len(folder.read_episodes()) >= 2)
    os.kill(program_of(folder, "simulator"), signal.SIGSTOP)
    errors = process.communicate(timeout=TIME_LIMIT_S)[1]
    assert process.returncode == 1
    assert "is started again" not in errors and "limphome-controller ended early (exit code 3)" in errors
    assert "limphome-simulator is stopped by a signal" in errors
    observe("exit code 1, no restart, simulator named")


@pytest.mark.fault(
    "Ctrl-Z and fg",
    injected="SIGTSTP, then SIGCONT, to the script",
    expected="both programs stop and go on with it; the run ends as an unbroken one",
)
def test_ctrl_z_stops_the_programs_too(unbroken, tmp_path, observe):
    folder = RunFolder(tmp_path / "run")
    process = start_script("train", "--config", SMOKE, "--out", folder.path, *SHORT)
    wait_until(process, lambda: len(folder.read_episodes()) >= 3)
    programs = [program_of(folder, name) for name in ("simulator", "controller")]
    os.killpg(process.pid, signal.SIGTSTP)  # as a terminal does
    wait_until(process, lambda: [state_of(pid) for pid in [process.pid, *programs]] == ["T"] * 3)
    rows = len(folder.read_episodes())
    time.sleep(0.5)
    assert len(folder.read_episodes()) == rows
    os.killpg(process.pid, signal.SIGCONT)
    assert expect_unbroken(process, folder, unbroken) == []
    observe("stopped at once, same table and policy")


@pytest.mark.fault(
    "a script is killed while it is stopped",
    injected="Ctrl-Z, then SIGKILL of the script",
    expected="both programs end; --resume goes on",
)
def test_programs_of_a_script_that_is_killed_while_stopped(tmp_path, observe):
    folder = RunFolder(tmp_path / "run")
    process = start_script("train", "--config", SMOKE, "--out", folder.path, *SHORT)
    wait_until(process, lambda: len(folder.read_episodes()) >= 13)
    programs = [program_of(folder, name) for name in ("simulator", "controller")]
    os.killpg(process.pid, signal.SIGTSTP)
    wait_until(process, lambda: [state_of(pid) for pid in [process.pid, *programs]] == ["T"] * 3)
    process.kill()
    process.communicate()
    deadline = time.monotonic() + 10
    while processes_that_mention(folder.path):
        assert time.monotonic() < deadline, "programs stayed behind"
        time.sleep(0.02)
    run_script("train", "--resume", folder.path, "--episodes", 20, "--no-figures", "--quiet")
    assert len(folder.read_episodes()) == 20
    observe("both gone, 20 episodes after --resume")


def state_of(pid):
    with open(f"/proc/{pid}/stat") as stat:
        return stat.read().rpartition(")")[2].split()[0]
