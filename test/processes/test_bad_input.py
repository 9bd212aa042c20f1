"""Bad input is refused in words that help, and nothing is started."""

import subprocess

import pytest

from conftest import ROOT, SMOKE, run_script
from limphome_lab import paths

# (name, text of the INI file, what the message must hold)
BAD_FILES = [
    ("unknown section", "[learnin]\nseed = 1\n", ["bad.ini:2", "[learnin] seed", "unknown"]),
    ("unknown key", "[learning]\nsed = 1\n", ["bad.ini:2", "[learning] sed", "unknown", "seed"]),
    ("bad number", "[learning]\n\nseed = abc\n", ["bad.ini:3", "[learning] seed = abc", "0 to 2147483647"]),
    ("trailing text", "[learning]\nlearning_rate = 0.1x\n", ["bad.ini:2", "learning_rate = 0.1x", "0 to 1"]),
    ("not a number", "[learning]\nlearning_rate = nan\n", ["bad.ini:2", "learning_rate = nan", "0 to 1"]),
    ("out of range", "[learning]\ndiscount_rate = 1.5\n", ["bad.ini:2", "discount_rate = 1.5", "0 to 1"]),
    ("bad choice", "[failure]\nmode = broken\n", ["bad.ini:2", "[failure] mode = broken", "locked free weak"]),
    ("duplicate key", "[learning]\nseed = 1\nseed = 2\n", ["bad.ini:3", "[learning] seed", "line 2"]),
    ("broken line", "[learning]\nseed = 1\nwhat is this\n", ["bad.ini:3"]),
    ("unfinished section", "[learning\nseed = 1\n", ["bad.ini:1"]),
    (
        "period not a multiple of the step",
        "[episode]\ndecision_period_s = 0.1234\n",
        ["decision_period_s = 0.1234", "whole number", "time_step_s"],
    ),
    (
        "two that the library takes only apart",
        "[rbf]\nwidth_floor = 1\ninitial_width = 0.5\n",
        ["[rbf] initial_width = 0.5", "[rbf] width_floor = 1"],
    ),
    ("section and key on a line", "[learning] seed = 7\n", ["bad.ini:1", "[section]", "line of its own"]),
]
BAD_SETS = [
    ("no dot", "seed=1", ["--set seed=1", "section.key=value"]),
    ("no value", "learning.seed", ["--set learning.seed", "section.key=value"]),
    ("unknown key", "learning.sed=1", ["--set learning.sed=1", "unknown"]),
    ("out of range", "learning.episodes=0", ["--set learning.episodes=0", "1 to 1000000"]),
]


def assert_refused(result, out, words):
    assert result.returncode == 2, result.stderr
    for word in words:
        assert word in result.stderr
    assert "Traceback" not in result.stderr
    assert not out.exists()


def by_name(cases):
    return pytest.mark.parametrize("given, words", [case[1:] for case in cases], ids=[case[0] for case in cases])


@by_name(BAD_FILES)
def test_configuration_file(tmp_path, given, words):
    file = tmp_path / "bad.ini"
    file.write_text(given)
    out = tmp_path / "run"
    assert_refused(run_script("train", "--config", file, "--out", out, check=False), out, words)


@by_name(BAD_SETS)
def test_set_option(tmp_path, given, words):
    out = tmp_path / "run"
    assert_refused(run_script("train", "--config", SMOKE, "--out", out, "--set", given, check=False), out, words)


def test_missing_configuration_file(tmp_path):
    out = tmp_path / "run"
    result = run_script("train", "--config", tmp_path / "none.ini", "--out", out, check=False)
    assert_refused(result, out, ["none.ini", "cannot be opened"])


def test_missing_robot(tmp_path):
    out = tmp_path / "run"
    result = run_script("train", "--config", SMOKE, "--robot", tmp_path / "none.urdf", "--out", out, check=False)
    assert_refused(result, out, ["none.urdf", "cannot be opened"])


def test_folder_that_is_not_empty(tmp_path):
    (tmp_path / "thesis.txt").write_text("two years of work")
    result = run_script("train", "--config", SMOKE, "--out", tmp_path, check=False)
    assert result.returncode == 2 and "not an empty folder" in result.stderr
    assert [file.name for file in tmp_path.iterdir()] == ["thesis.txt"]


def test_folder_that_cannot_be_made(tmp_path):
    file = tmp_path / "file"
    file.write_text("not a folder")
    result = run_script("train", "--config", SMOKE, "--out", file / "run", check=False)
    assert_refused(result, file / "run", [str(file / "run"), "Not a directory"])


def test_resume_of_what_is_not_a_run(tmp_path):
    result = run_script("train", "--resume", tmp_path, check=False)
    assert result.returncode == 2 and "not a run folder" in result.stderr


def test_resume_to_fewer_episodes_than_there_are(smoke_run):
    before = smoke_run.config.read_bytes()
    result = run_script("train", "--resume", smoke_run.path, "--episodes", 3, check=False)
    assert result.returncode == 2 and "--episodes 3" in result.stderr and "30 already" in result.stderr
    assert smoke_run.config.read_bytes() == before


@pytest.mark.parametrize(
    "program", [paths.program("simulator"), paths.program("controller")], ids=["simulator", "controller"]
)
@pytest.mark.parametrize(
    "change",
    [
        ("</robot>", ""),
        ('<parent link="upper_body"/>', '<parent link="nowhere"/>'),
        ('<crawler joint="left_crawler"', '<crawler joint="no_such_joint"'),
        ('mass value="498"', 'mass value="-498"'),
        ('mass value="498"', 'mass value="heavy"'),
        ('lower="-2.6" upper="2.6"', 'lower="2.6" upper="-2.6"'),
    ],
    ids=["cut short", "unknown link", "unknown joint", "negative mass", "mass in words", "empty range"],
)
def test_programs_refuse_a_bad_robot(tmp_path, program, change):
    good = (ROOT / "config" / "crawler.urdf").read_text()
    assert change[0] in good
    bad = tmp_path / "bad.urdf"
    bad.write_text(good.replace(*change))
    result = subprocess.run(
        [program, "--robot", bad, "--config", SMOKE, "--lcm-url", "memq://"], capture_output=True, text=True, timeout=30
    )
    assert result.returncode == 2, result.stderr
    assert "bad.urdf" in result.stderr


@pytest.mark.parametrize(
    "program", [paths.program("simulator"), paths.program("controller")], ids=["simulator", "controller"]
)
def test_programs_tell_of_a_missing_robot(tmp_path, program):
    command = [program, "--robot", tmp_path / "none.urdf", "--lcm-url", "memq://"]
    result = subprocess.run(command, capture_output=True, text=True, timeout=30)
    assert result.returncode == 2 and "none.urdf: cannot be opened" in result.stderr


@pytest.mark.parametrize(
    "program", [paths.program("simulator"), paths.program("controller")], ids=["simulator", "controller"]
)
def test_programs_refuse_a_folder_for_a_robot(tmp_path, program):
    command = [program, "--robot", tmp_path, "--lcm-url", "memq://"]
    result = subprocess.run(command, capture_output=True, text=True, timeout=30)
    assert result.returncode == 2
    assert str(tmp_path) in result.stderr and "cannot be read: " in result.stderr


@pytest.mark.parametrize(
    "program", [paths.program("simulator"), paths.program("controller")], ids=["simulator", "controller"]
)
@by_name(BAD_FILES)
def test_programs_refuse_a_bad_configuration(tmp_path, program, given, words):
    file = tmp_path / "bad.ini"
    file.write_text(given)
    result = subprocess.run([program, "--config", file], capture_output=True, text=True, timeout=30)
    assert result.returncode == 2
    assert all(word in result.stderr for word in words), result.stderr


@pytest.mark.parametrize(
    "program", [paths.program("simulator"), paths.program("controller")], ids=["simulator", "controller"]
)
@pytest.mark.parametrize("option", ["--print-settings", "--help-settings", "--help", "--version"])
def test_what_cannot_be_printed_is_told(program, option):
    with open("/dev/full", "w") as full:
        result = subprocess.run([program, option], stdout=full, stderr=subprocess.PIPE, text=True, timeout=30)
    assert result.returncode == 2 and "No space left" in result.stderr


def test_no_folder_is_made_where_the_bus_cannot_be_joined(tmp_path):
    command = [paths.program("controller"), "--config", SMOKE, "--out", tmp_path / "run", "--lcm-url", "nowhere://"]
    assert_refused(subprocess.run(command, capture_output=True, text=True), tmp_path / "run", ["cannot join the bus"])
