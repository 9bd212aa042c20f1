"""Bad input is refused in words that help, and nothing is started."""

import subprocess

import pytest

from conftest import ROOT, SMOKE, run_script, train
from limphome_lab import paths
from limphome_lab.runfolder import RunFolder

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


@pytest.fixture(scope="module")
def short_run(tmp_path_factory):
    """Run folder of 10 episodes: the programs may be those with sanitizers, which take their time."""
    out = tmp_path_factory.mktemp("short") / "run"
    train(out, "--episodes", 10, "--no-figures")
    return RunFolder(out)


def test_resume_to_fewer_episodes_than_there_are(short_run):
    before = short_run.config.read_bytes()
    result = run_script("train", "--resume", short_run.path, "--episodes", 3, check=False)
    assert result.returncode == 2 and "--episodes 3" in result.stderr and "10 already" in result.stderr
    assert short_run.config.read_bytes() == before


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


# (name, bytes of the INI file, words of the refusal, or None where it is read and seed is 7, episodes 3)
UNUSUAL_FILES = [
    ("carriage returns alone", b"[learning]\rseed = 7\repisodes = 3\r", None),
    ("Windows", b"\xef\xbb\xbf[learning]\r\nseed = 7\r\nepisodes = 3\r\n", None),
    ("indented keys", b"[learning]\n\tseed = 7\n\tepisodes = 3\n", None),
    ("an indented key set twice", b"[learning]\n  seed = 7\n  seed = 8\n", ["bad.ini:3", "already set at line 2"]),
    ("section and key on a line", b"[learning] seed = 7\n", ["bad.ini:1", "[section] must stand on a line of its own"]),
    ("UTF-16", "[learning]\nseed = 7\n".encode("utf-16"), ["bad.ini:1", "not a text file in ASCII or UTF-8"]),
    ("no end of line", b"[learning]\nseed = 7\nepisodes = 3", None),
]


@pytest.mark.parametrize(
    "content, words",
    [
        pytest.param(
            *case[1:],
            id=case[0],
            marks=pytest.mark.fault(
                "a configuration written in another way",
                injected="by an editor's settings",
                expected="read, or refused with the right line",
            ),
        )
        for case in UNUSUAL_FILES
    ],
)
def test_unusual_configuration(tmp_path, content, words, observe):
    file = tmp_path / "bad.ini"
    file.write_bytes(content)
    command = [paths.program("controller"), "--config", file, "--print-settings"]
    result = subprocess.run(command, capture_output=True, text=True, timeout=30)
    if words:
        assert result.returncode == 2 and all(word in result.stderr for word in words), result.stderr
        observe(result.stderr.strip().replace(f"{tmp_path}/", ""))
    else:
        assert "\nseed = 7\nepisodes = 3\n" in result.stdout
        observe("read: seed 7, 3 episodes")


def robot_with(change):
    """Text of the robot file with something bad."""
    good = (ROOT / "config" / "crawler.urdf").read_text()
    assert change[0] in good
    return good.replace(*change)


BAD_RUNS = [
    ("negative mass", ('mass value="498"', 'mass value="-498"'), [], "bad.urdf"),
    ("unknown joint", ('<crawler joint="left_crawler"', '<crawler joint="no_such_joint"'), [], "bad.urdf"),
    ("a robot without that joint", ("", ""), ["failure.actuator=joint_5"], "[failure] actuator = joint_5"),
]


@pytest.mark.parametrize(
    "change, assignments, word",
    [
        pytest.param(
            *case[1:],
            id=case[0],
            marks=pytest.mark.fault(
                "robot and settings that do not go together",
                injected="train with a bad robot file, or a failure of a joint that it has not",
                expected="refused, exit code 2, and no folder is left behind",
            ),
        )
        for case in BAD_RUNS
    ],
)
def test_no_folder_is_left_behind(tmp_path, change, assignments, word, observe):
    (tmp_path / "bad.urdf").write_text(robot_with(change))
    out = tmp_path / "run"
    sets = [each for assignment in assignments for each in ("--set", assignment)]
    arguments = ["--config", SMOKE, "--robot", tmp_path / "bad.urdf", "--out", out, *sets]
    result = run_script("train", *arguments, check=False)
    assert_refused(result, out, [word])
    observe(result.stderr.strip().replace(f"{tmp_path}/", ""))


@pytest.mark.fault(
    "a run in real time that nobody can arm",
    injected="train and evaluate with simulator.pace=real_time",
    expected="refused at once, naming scripts/launch --arm",
)
@pytest.mark.parametrize("name", ["train", "evaluate"])
def test_real_time_without_an_operator(short_run, tmp_path, observe, name):
    run = {"train": ("--config", SMOKE), "evaluate": (short_run.path,)}[name]
    out = tmp_path / "run"
    result = run_script(name, *run, "--set", "simulator.pace=real_time", "--out", out, check=False)
    assert_refused(result, out, ["simulator.pace = real_time", "scripts/launch --arm"])
    observe("exit code 2")


@pytest.mark.parametrize(
    "command",
    [("train", "--resume"), ("evaluate",), ("plot",), ("compare",), ("results",), ("diagnose",)],
    ids=" ".join,
)
def test_run_folder_without_a_name(tmp_path, command):
    result = run_script(*command, "", check=False)
    assert_refused(result, tmp_path / "run", ["the name of a run folder is empty"])
