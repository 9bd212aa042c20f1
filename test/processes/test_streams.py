"""What is printed to where nobody reads, or no text can be written, ends no run and gives no traceback."""

import os
import subprocess

import pytest

from conftest import ROOT, SMOKE, TIME_LIMIT_S, run_script
from limphome_lab.runfolder import RunFolder

SHORT = ["--config", str(SMOKE), "--episodes", "2", "--set", "episode.step_limit=20", "--no-figures"]


def shell(command, **options):
    """Runs a line of shell; the scripts are at hand as $S."""
    environment = os.environ | {"S": str(ROOT / "scripts")}
    return subprocess.run(
        ["bash", "-c", command], capture_output=True, text=True, timeout=TIME_LIMIT_S, env=environment, **options
    )


def pipe_that_nobody_reads():
    reader, writer = os.pipe()
    os.close(reader)
    return writer


@pytest.mark.fault(
    "stderr leads nowhere",
    injected="closed; a pipe that nobody reads; a full device",
    expected="the run ends whole, and no file of it holds what was to be printed",
)
@pytest.mark.parametrize("where", ["2>&-", "2>/dev/full", "2>&$NOBODY", ">&- 2>&- <&-"])
def test_stderr_that_leads_nowhere(tmp_path, observe, where):
    folder = RunFolder(tmp_path / "run")
    nobody = pipe_that_nobody_reads()
    line = f"$S/train {' '.join(SHORT)} --out {folder.path} {where.replace('$NOBODY', str(nobody))}"
    result = shell(line, pass_fds=[nobody])
    os.close(nobody)
    assert result.returncode == 0, result.stderr
    assert [row.episode for row in folder.read_episodes()] == [1, 2]
    assert "training in" not in "".join(file.read_text(errors="replace") for file in folder.path.glob("*.*"))
    observe("exit code 0, 2 of 2 rows")


@pytest.mark.fault(
    "stdout leads nowhere",
    injected="evaluate --json into a pipe that nobody reads, and onto a full device",
    expected="exit code 1 without a traceback",
)
@pytest.mark.parametrize("where", [">&$NOBODY", ">/dev/full"])
def test_stdout_that_leads_nowhere(smoke_run, tmp_path, observe, where):
    nobody = pipe_that_nobody_reads()
    options = f"--episodes 1 --set episode.step_limit=20 --json --out {tmp_path / 'evaluation'}"
    line = f"$S/evaluate {smoke_run.path} {options} {where.replace('$NOBODY', str(nobody))}"
    result = shell(line, pass_fds=[nobody])
    os.close(nobody)
    assert result.returncode == 1
    assert "Traceback" not in result.stderr and "Exception" not in result.stderr
    observe(f"exit code 1: {result.stderr.strip() or 'silent'}")


@pytest.mark.fault(
    "a folder whose name is no UTF-8",
    injected="bytes 0xff and 0xe9 in --out",
    expected="the run, its figures and its evaluation are as in any other",
)
def test_name_that_is_no_utf8(tmp_path, observe):
    folder = os.fsencode(tmp_path) + b"/r\xff\xe9n"
    for command in (
        ["train", *SHORT[:-1], "--quiet", "--out", folder],
        ["evaluate", folder, "--episodes", "1", "--set", "episode.step_limit=20", "--json"],
        ["plot", folder],
        ["diagnose", folder],
        ["train", "--resume", folder, "--episodes", "3", "--quiet"],
    ):
        command[0] = ROOT / "scripts" / command[0]
        result = subprocess.run(command, capture_output=True, timeout=TIME_LIMIT_S, stdin=subprocess.DEVNULL)
        assert result.returncode == 0, result.stderr
    assert os.path.exists(folder + b"/figures/fig9_motion.png")
    observe("trained, evaluated, plotted, diagnosed and resumed")


@pytest.mark.fault(
    "a folder that cannot be",
    injected="a name of 300 characters, a path of 600, below a file, below /proc",
    expected="refused in a line that names it, exit code 2",
)
def test_folder_that_cannot_be(tmp_path, observe):
    (tmp_path / "file").write_text("")
    names = ["n" * 300, "/".join(["folder" * 10] * 10), "file/run", "/proc/nothing/run"]
    told = []
    for name in names:
        for option in ("--out", "--resume"):
            arguments = SHORT if option == "--out" else ["--no-figures"]
            result = run_script("train", *arguments, option, tmp_path / name, check=False)
            assert result.returncode == 2 and "Traceback" not in result.stderr, result.stderr
            assert str(tmp_path / name)[:100] in result.stderr
            told.append(result.stderr.strip().rpartition(": ")[2])
    observe(", ".join(dict.fromkeys(told)))
