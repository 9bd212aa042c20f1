"""scripts/replay: what the page shows of a recording is what was recorded, and a video has its pictures in order."""

import os
import re
import shutil
import signal
import subprocess
import time

import numpy as np
import pytest
from browsing import SLOW_MS, Page

from conftest import TIME_LIMIT_S, processes_that_mention, run_script, start_script, wait_until
from limphome_lab import robot
from limphome_lab.view import video
from limphome_lab.view.recorded import Recording


@pytest.fixture
def replay(browser):
    """Opens the page of scripts/replay with these arguments."""
    started = []

    def open_page(*arguments):
        process = start_script("replay", *arguments)
        started.append(process)
        address = re.search(r"http://\S+", process.stdout.readline())
        assert address, process.communicate()[1]
        return Page(browser, address[0])

    yield open_page
    for process in started:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=TIME_LIMIT_S)
        assert process.returncode == 128 + signal.SIGINT


def recording(run):
    return Recording(run.messages, robot.read(run.robot))


def drag_to(page, share):
    """The slider's thumb to a share of its track."""
    track = page.page.locator(".mantine-Slider-track").first.bounding_box()
    thumb = page.page.get_by_role("slider").bounding_box()
    mouse, middle = page.page.mouse, thumb["y"] + thumb["height"] / 2
    mouse.move(thumb["x"] + thumb["width"] / 2, middle)
    mouse.down()
    mouse.move(track["x"] + share * track["width"], middle, steps=3)
    mouse.up()


def shown_time(page):
    return float(page.find(r"([\d.]+) s of [\d.]+ s,")[0])


def moment_at(page, share, duration):
    """(time, episode, decision, Q, margin) that are shown, once the slider was dragged there and they stay."""
    shown, deadline = None, time.monotonic() + SLOW_MS / 1000
    while shown is None or abs(float(shown[0]) - share * duration) > 0.05 * duration:
        assert time.monotonic() < deadline, f"the slider is at {shown} of {duration} s"
        drag_to(page, share)
        before = None
        while shown is None or shown != before:
            page.page.wait_for_timeout(500)
            before = shown
            shown = page.find(
                r"([\d.]+) s of [\d.]+ s,[\s\S]*Episode (\d+), decision (\d+)"
                r"[\s\S]*Q of the action\s+(\S+)[\s\S]*stability margin\s+(\S+) m"
            )
            assert time.monotonic() < deadline, f"it goes on: {shown}"
    return shown


def test_slider_shows_the_moment_that_was_recorded(smoke_run, replay):
    track = recording(smoke_run).episode(7)
    page = replay(smoke_run.path, "--episode", 7)
    page.find(r"[\d.]+ s of " + f"{track.duration:.2f} s")
    page.press("Pause  (P)")
    page.find(r"Play\s+\(P\)")
    assert page.find(r"outcome\s+(\w+)\s+decisions\s+(\d+)") == (track.outcome, str(track.ending.steps))
    assert page.find(r"reward\s+(-?[\d.]+)")[0] == f"{track.ending.reward:.2f}"
    pictures = []
    for share in (0.2, 0.8):
        shown = moment_at(page, share, track.duration)
        decision = track.decision(float(shown[0]))
        assert shown[1:] == ("7", str(decision.step), f"{decision.q:.3f}", f"{decision.stability_margin:.3f}")
        pictures.append(page.picture())
    assert pictures[0] != pictures[1], "the robot has moved"
    assert page.foreign == []


def test_two_runs_side_by_side(smoke_run, replay, tmp_path):
    shutil.copytree(smoke_run.path, tmp_path / "other", ignore=shutil.ignore_patterns("evaluation", "export"))
    page = replay(smoke_run.path, tmp_path / "other", "--speed", 0.2)  # not over before the page is there
    last = recording(smoke_run).episode()
    page.find(rf"{last.outcome}[\s\S]*{tmp_path.name}/other[\s\S]*{last.outcome}")
    first, deadline = shown_time(page), time.monotonic() + SLOW_MS / 1000
    while shown_time(page) == first:
        assert time.monotonic() < deadline, "it plays by itself"


def test_what_cannot_be_shown_is_told(smoke_run, tmp_path):
    for arguments, told in (
        (["--episode", 99], "no states of episode 99; it has those of 1 to 30"),
        (["--speed", 0], "--speed 0: must be from"),
        (["--video", tmp_path / "x.avi"], "ends in none of .mp4, .gif"),
        (["--video", tmp_path / "none" / "x.gif"], "there is no folder"),
        (["--video", tmp_path / "x.gif", "--angle", "below"], "--angle 'below': must be one of corner, side"),
        (["--video", tmp_path / "x.gif", "--size", "33x20"], "--size '33x20': must be WIDTHxHEIGHT"),
    ):
        result = run_script("replay", smoke_run.path, *arguments, check=False)
        assert result.returncode == 2 and told in result.stderr
    assert list(tmp_path.iterdir()) == []


def decoded(file, width, height):
    """[n x height x width x 3] pictures of a video, by ffmpeg."""
    command = ["ffmpeg", "-loglevel", "error", "-i", file, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    content = subprocess.run(command, check=True, capture_output=True).stdout
    return np.frombuffer(content, np.uint8).reshape(-1, height, width, 3).astype(int)


needs_browser = pytest.mark.skipif(
    not (shutil.which("chromium") and shutil.which("ffmpeg")), reason="chromium or ffmpeg is missing"
)


@needs_browser
def test_video_shows_the_robot_move(smoke_run, tmp_path):
    file = tmp_path / "seen.gif"
    speed, rate = 100, 12.5  # pictures a second; an episode of 100 s
    size = ["--size", "96x64", "--angle", "corner,above"]
    result = run_script("replay", smoke_run.path, "--episode", 7, "--speed", 100, "--video", file, *size)
    assert result.stdout.strip() == str(file)
    pictures = decoded(file, 192, 64)
    driving = recording(smoke_run).episode(7).duration / speed * rate
    assert abs(len(pictures) - driving - rate) <= 1
    both = pictures[:, :48]  # without the caption
    moved = np.abs(np.diff(both, axis=0)).max(axis=(1, 2, 3))
    assert (moved[: int(driving) - 1] > 20).all(), "each picture is another"
    # the page brings lines and belts, unlike where things are, up to date in a later picture, a slow one some later
    assert (moved[int(driving) + 8 :] < 20).all(), "and at the end it stands"
    assert [each.name for each in tmp_path.iterdir()] == [file.name]


@pytest.mark.skipif(not shutil.which("ffmpeg"), reason="ffmpeg is not installed")
@pytest.mark.parametrize("suffix", [".mp4", ".gif"])
def test_videos_have_each_picture_in_its_place(tmp_path, suffix):
    rate, options = video.FORMATS[suffix]
    file = tmp_path / f"grey{suffix}"
    shades = np.arange(10, 250, 16)
    with video.Encoder(file, (64, 32), rate, options) as encoder:
        for shade in shades:
            encoder.add(np.full((32, 64, 3), shade, np.uint8))
        encoder.finish()
    assert decoded(file, 64, 32).mean(axis=(1, 2, 3)) == pytest.approx(shades, abs=4)


@needs_browser
def test_interrupted_video_leaves_no_browser_and_no_file(smoke_run, tmp_path):
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    words = ["--episode", 7, "--video", tmp_path / "long.mp4", "--size", "64x64"]
    process = start_script("replay", smoke_run.path, *words, env={**os.environ, "TMPDIR": str(temporary)})
    wait_until(process, lambda: processes_that_mention(temporary))
    process.send_signal(signal.SIGINT)
    _, told = process.communicate(timeout=TIME_LIMIT_S)
    assert process.returncode == 128 + signal.SIGINT and "Traceback" not in told
    assert [each.name for each in tmp_path.iterdir()] == ["temporary"] and list(temporary.iterdir()) == []
    assert processes_that_mention(temporary) == []
