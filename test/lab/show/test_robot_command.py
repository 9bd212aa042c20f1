"""scripts/robot: what it tells and draws, and that what --template writes is a robot at any size."""

import json
import subprocess
import sys

import pytest

from limphome_lab import paths, robot
from limphome_lab.show import template

CRAWLER = paths.CONFIG / "crawler.urdf"


def tell(*words, cwd=None):
    command = [sys.executable, "-m", "limphome_lab.show.robot", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, cwd=cwd)


@pytest.fixture
def write(tmp_path):
    """Writes a robot by --template and its options."""

    def write(*words):
        result = tell("--template", *words)
        assert result.returncode == 0, result.stderr
        file = tmp_path / "mine.urdf"
        file.write_text(result.stdout)
        return file

    return write


def test_text_and_picture(tmp_path):
    file = tmp_path / "mine.urdf"
    file.write_bytes(CRAWLER.read_bytes())
    result = tell(file)
    assert result.returncode == 0, result.stderr
    assert result.stdout.startswith("robot crawler: 945 kg, arm of 3 joints\n")
    assert file.with_suffix(".png").read_bytes().startswith(b"\x89PNG")


def test_json_draws_only_where_it_is_told_to(tmp_path):
    file = tmp_path / "mine.urdf"
    file.write_bytes(CRAWLER.read_bytes())
    result = tell(file, "--json")
    told = json.loads(result.stdout)
    assert (result.returncode, told["accepted"], told["name"]) == (0, True, "crawler")
    assert list(tmp_path.iterdir()) == [file]
    assert tell(file, "--json", "--picture", tmp_path / "here.png").returncode == 0
    assert (tmp_path / "here.png").exists()


def test_names_of_robots_that_come_along_are_found(tmp_path):
    assert tell("two_arm.urdf", "--json", cwd=tmp_path).returncode == 0


def test_refused_with_every_fault_and_no_picture(tmp_path):
    file = tmp_path / "mine.urdf"
    text = CRAWLER.read_text().replace('effort="3000"', 'effort="much"').replace('home="0.6"', 'home="9"')
    file.write_text(text)
    result = tell(file)
    assert result.returncode == 2
    assert 'effort="much"' in result.stderr
    assert 'home="9"' in result.stderr
    assert result.stdout == ""
    told = json.loads(tell(file, "--json").stdout)
    assert told["accepted"] is False
    assert result.stderr.splitlines() == told["faults"] + told["notices"]
    assert list(tmp_path.iterdir()) == [file]


def test_programs_refuse_with_the_same_words(tmp_path):
    file = tmp_path / "mine.urdf"
    file.write_text(CRAWLER.read_text().replace('radius="0.18"', 'radius="-1"'))
    told = [tell(file).stderr]
    for name in ("controller", "simulator"):
        result = subprocess.run([paths.program(name), "--robot", file, "--check"], capture_output=True, text=True)
        assert result.returncode == 2
        told.append(result.stderr)
    assert told[0] == told[1] == told[2] != ""


def test_facts_of_the_crawler_robot():
    """Masses, and what follows from the geometry worked out by hand: swing at 0, boom 1.1 m, arm 0.8 m."""
    told = robot.read(CRAWLER).told
    assert told["mass"] == pytest.approx(945)
    (tip,) = told["tips"]
    assert tip["reach"] == pytest.approx(0.4 + 1.1 + 0.8)
    assert told["home"]["rests"] and not told["home"]["braced"]
    assert told["sweep"]["least"]["margin"] <= told["home"]["margin"]
    assert told["tumbles_at"]["left"] == pytest.approx(told["tumbles_at"]["right"], abs=1e-3)


@pytest.mark.parametrize("length", [0.15, 0.5, 1.6, 6])
def test_template_is_a_robot_at_any_size(write, length):
    file = write("--length", length)
    told = robot.read(file).told
    assert not told["notices"]
    assert told["home"]["rests"] and not told["home"]["braced"]
    assert told["mass"] == pytest.approx(909.5 * (length / 1.6) ** 3, rel=1e-2)
    assert told["sweep"]["braced"] > 0.1 * told["sweep"]["postures"]
    assert all(crawler["length"] == pytest.approx(length) for crawler in told["crawlers"])
    for tip in told["tips"]:
        assert tip["strength_at_reach"]["press"] > 0.3 * told["mass"] * template.GRAVITY


def test_template_has_the_dimensions_it_is_told(write):
    words = "--length 2 --width 1.5 --track-width 0.4 --track-radius 0.25 --mass 700 --upper-mass 300"
    file = write(*words.split(), "--arm", "1.2,0.9,0.4", "--arm-mass", "50,30,10")
    told = robot.read(file).told
    left, right = told["crawlers"]
    assert told["mass"] == pytest.approx(700 + 300 + 90)
    assert left["centre"][1] - right["centre"][1] + left["width"] == pytest.approx(1.5)
    assert (left["length"], left["width"], left["radius"]) == pytest.approx((2, 0.4, 0.25))
    assert [body["mass"] for body in told["bodies"]][-3:] == pytest.approx([50, 30, 10])
    (tip,) = told["tips"]
    assert tip["reach"] == pytest.approx(0.25 * 2 + 1.2 + 0.9 + 0.4, rel=0.01)


def test_arm_of_one_section(write):
    told = robot.read(write("--arm", "1.5")).told
    assert told["sweep"]["braced"] > 0


@pytest.mark.parametrize(
    "words, reason",
    [
        (["--length", "-1"], "--length: -1 must be above 0"),
        (["--arm", "0.3,0.2"], "cannot reach the ground from a shoulder 0.8 m above it"),
        (["--arm", "1,1,1,1,1,1"], "--arm: 6 sections; must be 1 to 5"),
        (["--arm-mass", "1"], "--arm-mass: 1 masses for 2 sections"),
        (["--track-radius", "2"], "--track-radius: twice 2 m is longer"),
        (["--track-width", "1"], "--track-width: two of 1 m leave nothing"),
    ],
)
def test_what_is_no_robot_is_told_by_its_option(words, reason):
    result = tell("--template", *words)
    assert result.returncode == 2
    assert reason in result.stderr
    assert result.stdout == ""


def test_either_a_file_or_a_template():
    assert tell().returncode == 2
    assert tell(CRAWLER, "--template").returncode == 2
    assert "dimensions are for --template" in tell(CRAWLER, "--length", "1").stderr
