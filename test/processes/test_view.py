"""scripts/view in a browser: what is seen there is what the run does, and what is pressed there happens to it."""

import re
import signal
import time

import pytest
from browsing import Page

from conftest import SMOKE, TIME_LIMIT_S, processes_that_mention, start_script
from limphome_lab.channels import DECISION
from limphome_lab.messages import recorded

PERIOD_S = 0.5


@pytest.fixture
def training(tmp_path):
    """scripts/train --view: (process, run folder, address of the page)"""
    run = tmp_path / "run"
    options = ["--config", SMOKE, "--episodes", "2000", "--out", run, "--no-figures", "--quiet", "--view"]
    process = start_script("train", *options)
    address = None
    while address is None:
        line = process.stderr.readline()
        assert line, "ended before it told an address"
        address = re.search(r"http://\S+", line)
    yield process, run, address[0]
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
    process.communicate(timeout=TIME_LIMIT_S)


def plant_time(page):
    return float(page.find(r"plant time ([\d.]+) s")[0])


def test_what_the_page_shows_and_what_is_pressed_in_it(training, browser, tmp_path):
    process, run, address = training
    page = Page(browser, address)
    page.find(r"4 times real time")  # as it begins where a page was asked for

    page.press("Pause")
    page.find(r"pace: paused")
    time.sleep(0.5)  # texts are renewed five times a second
    paused = plant_time(page)
    before = page.picture()
    assert plant_time(page) == paused, "nothing moves"
    episode, step = page.find(r"Episode (\d+), decision (\d+)")
    value, margin = page.find(r"Q of the action\s+(\S+)[\s\S]*stability margin\s+(\S+) m")

    page.press("One decision")
    while plant_time(page) == paused:
        assert process.poll() is None
    time.sleep(0.5)
    assert plant_time(page) == pytest.approx(paused + PERIOD_S), "one decision, and no more"
    page.find(r"pace: paused")

    page.press("Go on")
    page.find(r"4 times real time")
    while plant_time(page) < paused + 8 * PERIOD_S:
        assert process.poll() is None
    assert page.picture() != before, "the robot has moved"
    assert page.foreign == []

    page.page.close()
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=TIME_LIMIT_S)
    assert processes_that_mention(f"limphome_lab.view.view\0--pid\0{process.pid}\0") == []
    shown = [
        decision
        for _, decision in recorded(run / "messages.lcmlog", DECISION)
        if (decision.episode, decision.step) == (int(episode), int(step))
    ]
    assert (value, margin) in [(f"{each.q:.3f}", f"{each.stability_margin:.3f}") for each in shown]


def test_it_joins_and_leaves_and_the_next_run_shows_up(browser, tmp_path):
    view = start_script("view")
    address = re.search(r"http://\S+", view.stdout.readline())[0]
    page = Page(browser, address)
    page.find("nothing is running")
    for name in ("first", "second"):
        options = ["--config", SMOKE, "--episodes", "100000", "--out", tmp_path / name, "--no-figures", "--quiet"]
        training = start_script("train", *options)
        page.find(rf"{name}[\s\S]*Episode \d+, decision \d+")
        training.send_signal(signal.SIGINT)
        training.communicate(timeout=TIME_LIMIT_S)
        page.find("has ended")
    view.send_signal(signal.SIGINT)
    assert view.communicate(timeout=TIME_LIMIT_S)[1] == ""
    assert view.returncode == 128 + signal.SIGINT
    assert processes_that_mention("limphome_lab.view.feed") == []
