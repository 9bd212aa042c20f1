"""scripts/view in a browser: what is seen there is what the run does, and what is pressed there happens to it."""

import json
import re
import signal
import time

import pytest
from browsing import SLOW_MS, Page

from conftest import SMOKE, TIME_LIMIT_S, processes_that_mention, start_script, wait_until
from limphome import pace_t, pose_t
from limphome_lab import registry
from limphome_lab.channels import DECISION, PACE, POSE
from limphome_lab.messages import recorded
from limphome_lab.run import hand
from limphome_lab.view.feed import Feed
from limphome_lab.view.operate import ASKED, TOLD

PERIOD_S = 0.5
SWING = 2  # actuator


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


def heard(feed, condition):
    """What a feed has told until `condition(channel, data)`."""
    deadline = time.monotonic() + TIME_LIMIT_S
    while time.monotonic() < deadline:
        messages = feed.newest()
        assert messages is not None, "the feed has ended"
        for message in messages:
            if condition(*message):
                return message
        time.sleep(0.02)
    raise AssertionError("waited in vain")


def pace_of(action, pace=0.0):
    message = pace_t()
    message.action, message.pace = action, pace
    return message.encode()


def test_a_feed_takes_the_robot_by_hand_and_gives_it_back(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    options = ["--config", SMOKE, "--episodes", "100000", "--out", tmp_path / "run", "--no-figures", "--quiet"]
    process = start_script("train", *options)
    wait_until(process, registry.running)
    feed = Feed(registry.running()[0])

    def ask(**asked):
        feed.say(ASKED, json.dumps(asked).encode())

    def in_charge(who):
        return lambda channel, data: channel == TOLD and json.loads(data).get("in_charge") == who

    def swing(channel, data):
        return channel == POSE and pose_t.decode(data).actuator_position[SWING]

    try:
        heard(feed, lambda channel, _: channel == POSE)
        feed.say(PACE, pace_of(pace_t.RUN, 1.0))
        heard(feed, lambda channel, data: channel == POSE and pose_t.decode(data).pace == 1.0)
        ask(do="take")
        heard(feed, in_charge(hand.ME))
        before = swing(*heard(feed, lambda channel, _: channel == POSE))
        ask(drive=[0, 0, 1 if before < 0 else -1])
        heard(feed, lambda channel, data: channel == POSE and abs(swing(channel, data) - before) > 0.1)
        ask(do="give")
        heard(feed, in_charge(hand.LEARNER))
    finally:
        feed.close()
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=TIME_LIMIT_S)


class Live(Page):
    def plant_time(self):
        return float(self.find(r"plant time ([\d.]+) s")[0])

    def step(self, before):
        """One decision on from a plant time; returns the one after."""
        self.press("Step")
        deadline = time.monotonic() + SLOW_MS / 1000
        while self.plant_time() == before:
            assert time.monotonic() < deadline
        time.sleep(0.5)
        return self.plant_time()


def test_what_the_page_shows_and_what_is_pressed_in_it(training, browser, tmp_path):
    process, run, address = training
    page = Live(browser, address)
    page.find(r"4 times real time")  # as it begins where a page was asked for

    page.press("Pause")
    page.find(r"pace: paused")
    time.sleep(0.5)  # texts are renewed five times a second
    paused = page.plant_time()
    before = page.picture()
    assert page.plant_time() == paused, "nothing moves"
    episode, step = page.find(r"Episode (\d+), decision (\d+)")
    value, margin = page.find(r"Q of the action\s+(\S+)[\s\S]*stability margin\s+(\S+) m")

    stepped = page.step(paused)  # to the end of the period that it was paused in
    assert stepped <= paused + PERIOD_S + 1e-6
    assert page.step(stepped) == pytest.approx(stepped + PERIOD_S), "one decision, and no more"
    page.find(r"pace: paused")

    page.press("Go on")
    page.find(r"4 times real time")
    while page.plant_time() < paused + 8 * PERIOD_S:
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
