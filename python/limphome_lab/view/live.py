"""A page that shows whichever pair is running: joins it, leaves it at its end, and waits for the next."""

import collections
import contextlib
import json
import os
import queue
import time

import numpy as np

from limphome import decision_t, episode_t, pose_t, robot_state_t, status_t
from limphome_lab import command, paths, registry, robot
from limphome_lab.channels import DECISION, EPISODE, POSE, STATE, STATUS
from limphome_lab.ending import InputError
from limphome_lab.goal import goal
from limphome_lab.run.viewing import JOINED
from limphome_lab.runfolder import Episode, RunFolder
from limphome_lab.view import operate, told
from limphome_lab.view.controls import Eye, Pace
from limphome_lab.view.curves import Curves
from limphome_lab.view.drive import Drive
from limphome_lab.view.feed import Feed
from limphome_lab.view.frame import frame_of
from limphome_lab.view.ground import Ground
from limphome_lab.view.panels import Told
from limphome_lab.view.scene import RobotScene
from limphome_lab.view.server import Page

FRAME_S = 1 / 30
FREE_FRAME_S = 1 / 10  # of a plant that goes as fast as it can: the eye sees leaps anyway, and the run has the time
TEXT_S = 0.25  # between two times that text and plots are brought up to date
LOOK_S = 0.5  # between two looks for pairs
POSE_STALE_S = 1.0  # a plant that has sent no pose for so long is shown by its states
FIRST_PACE = 4.0  # times real time, of a run that was started with its page
OPEN_WITHIN_S = 60.0  # of its start: until then it is held to that pace, and its page kept, without anybody looking
LINGER_S = 3.0  # after the last page was closed, of a run that has ended; a page that is loaded anew is back by then
KEPT_STATES = 16  # to find the one that a decision tells of
PANEL_WIDTH = 380  # [px]

TYPES = {POSE: pose_t, STATE: robot_state_t, DECISION: decision_t, EPISODE: episode_t, STATUS: status_t}


class Live:
    """`run`: folder of the one to wait for, None: the newest. `pid`: of the one to show alone, until nobody looks;
    `joins`: descriptor on which it is waited for."""

    def __init__(self, page, run=None, pid=None, joins=None):
        self.page, self.run, self.pid, self.joins = page, run, pid, joins
        self.pair = self.feed = self.scene = self.pose = None
        self._has_joined = False
        self._looked_at = float("-inf")
        self._later = queue.SimpleQueue()  # what a person has asked for, done between two frames
        gui = page.gui
        gui.configure_theme(control_width="large", show_logo=False, show_share_button=False, brand_color=(31, 95, 168))
        gui.main_panel.dock_right()
        gui.main_panel.set_width(PANEL_WIDTH)
        self._title = gui.add_markdown("")
        tabs = gui.add_tab_group()
        with tabs.add_tab("Watch"):
            self.pace = Pace(gui, self._say, self._later.put)
            self.eye = Eye(page)
            self.told = Told(gui)
        with tabs.add_tab("Drive"):
            self.drive = Drive(gui, self._ask, self._later.put)
        with tabs.add_tab("Curves"):
            self.curves = Curves(gui)
        with tabs.add_tab("Counters"):
            self._counters_text = gui.add_markdown("")
        self._tell_waiting()

    def watch(self):
        """Until there is nothing more to show, which only one with a `pid` has."""
        looked = shown = float("-inf")
        with contextlib.ExitStack() as stack:
            stack.callback(self._leave)
            while not self._done():
                free = self.pose is not None and self.pose.pace == pose_t.PACE_FREE
                due = time.monotonic() + (FREE_FRAME_S if free else FRAME_S)
                while not self._later.empty():
                    self._later.get()()
                if due - looked >= LOOK_S:
                    looked = due
                    self._look()
                if self.feed is not None:
                    self._hear()
                    self._keep()
                if due - shown >= TEXT_S:
                    shown = due
                    self._tell()
                time.sleep(max(0.0, due - time.monotonic()))

    def _keep(self):
        """Says that somebody looks. One that was started with its page goes slowly enough to be seen from the start."""
        looked_at = bool(self.page.get_clients())
        if looked_at:
            self._looked_at = time.monotonic()
            self.drive.keep()
        else:
            self.drive.let_go()
        awaited = self.pid is not None and time.monotonic() - self._joined < OPEN_WITHIN_S
        if self.pid is not None and self.pace.wanted is None and self._lockstep:
            self.pace.run(FIRST_PACE)
        if self._lockstep and (looked_at or awaited):
            self.pace.keep()

    def _done(self):
        """Only of one that was started with the page: it has ended, and nobody looks any more."""
        if self.pid is None or self.pair is not None or not self._has_joined:
            return False
        if self.page.get_clients():
            self._looked_at = time.monotonic()
        return time.monotonic() - self._looked_at > LINGER_S

    def _look(self):
        """Joins a pair, or notices that the one it shows has ended."""
        pairs = registry.running()
        if self.pair is not None and self.pair not in pairs:
            self._leave()
        if self.pair is None:
            wanted = [each for each in pairs if self._is_wanted(each)]
            if wanted:
                self._join(wanted[0])

    def _is_wanted(self, pair):
        return (self.run is None or pair["run"] == str(self.run)) and self.pid in (None, pair["pid"])

    def _join(self, pair):
        folder = RunFolder(pair["run"])
        try:
            described = robot.read(folder.robot)
            settings = folder.settings()
        except (InputError, OSError):
            return  # it is being made, or has gone; the next look will tell
        if self.scene is not None:
            self.scene.remove()
        self.robot = described
        self.scene = RobotScene(self.page.scene, described)
        self.ground = Ground(self.page.scene, folder.config, folder.robot, settings)
        self.ground.show_around((0, 0))
        self.pair, self.feed, self._has_joined = pair, Feed(pair), True
        self.statuses, self.decision, self.pose = {}, None, None
        self._states = collections.OrderedDict()
        self._posed = float("-inf")
        self._lockstep = None  # not known yet
        self._joined = time.monotonic()
        self._looked_at = max(self._looked_at, self._joined + OPEN_WITHIN_S - LINGER_S)
        self.curves.clear()
        self.drive.fit(described.actuators)
        self.episodes = []
        with contextlib.suppress(InputError):  # its table is being begun, or is none
            self.episodes = folder.read_episodes()
        for episode in self.episodes:
            self.curves.add_episode(episode.episode, episode.reward)
        self._title.content = f"### {paths.shown(pair['run'])}"
        if self.joins is not None:
            os.write(self.joins, JOINED)

    def _leave(self):
        if self.feed is not None:
            self.feed.close()
            self._title.content += "\n\nhas ended"
        self.pair = self.feed = None

    def _tell_waiting(self):
        self._title.content = (
            f"### nothing is running\n\nStart `{command.called('train')}` or `{command.called('launch')}`: "
            "this page will show it."
        )

    def _say(self, channel, message):
        if self.feed is not None:
            self.feed.say(channel, message.encode())

    def _ask(self, asked):
        if self.feed is not None:
            self.feed.say(operate.ASKED, json.dumps(asked).encode())

    def _hear(self):
        messages = self.feed.newest()
        for channel, data in messages or []:
            if channel == operate.TOLD:
                self.drive.hear(json.loads(data))
                continue
            with contextlib.suppress(ValueError):  # the bus is open to all
                self._take(channel, TYPES[channel].decode(data))

    def _take(self, channel, message):
        now = time.monotonic()
        if channel == POSE:
            self._posed = now
            self.pose = message
            self._show(frame_of(message))
        elif channel == STATE:
            self._lockstep = bool(message.lockstep)
            self._states[message.session, message.seq] = message
            while len(self._states) > KEPT_STATES:
                self._states.popitem(last=False)
            if now - self._posed > POSE_STALE_S:
                self._show(frame_of(message))
        elif channel == DECISION:
            self._decided(message)
        elif channel == EPISODE:
            self._ended(message)
        elif channel == STATUS:
            self.statuses[message.process] = message

    def _show(self, frame):
        if len(frame.health) != len(self.robot.actuators):
            return  # of another plant
        self.ground.show_around(frame.position)
        self.eye.position = frame.position
        with self.page.atomic():
            self.eye.apply(self.scene)
            self.scene.show(frame)
        if frame.margin is not None:
            self.curves.add_margin(frame.time, frame.margin)

    def _decided(self, decision):
        self.decision = decision
        self.curves.add_decision(decision)
        state = self._states.get((decision.session, decision.seq))
        if state is None:
            return
        self.scene.set_goal(*goal(decision, state), self.ground.height)

    def _ended(self, message):
        if self.episodes and message.episode <= self.episodes[-1].episode:
            return
        episode = Episode(
            message.episode,
            told.outcome(message),
            message.steps,
            message.duration,
            *(message.reward, message.reward_motion, message.reward_goal, message.reward_stability),
            message.reward_tumble,
            message.lateral_error,
            message.heading_change,
            message.temperature,
        )
        self.episodes.append(episode)
        self.curves.add_episode(episode.episode, episode.reward)

    def _tell(self):
        if self.scene is None:
            return
        now = None
        if self.decision is not None:
            now = self.decision.episode, self.decision.step
            health = self.scene.frame.health if self.scene.frame is not None else np.zeros(len(self.robot.actuators))
            self.told.decision(self.robot, self.decision, health)
        self.told.episodes(now, self.episodes)
        self._counters_text.content = told.counters(self.statuses)
        if self.pose is not None:
            self.pace.text.content = f"pace: **{told.pace(self.pose.pace)}**, plant time {self.pose.utime / 1e6:.1f} s"
            self.pace.show(self.pose.pace, bool(self._lockstep))
        self.curves.draw()


def serve(run=None, port=0, pid=None, joins=None, tell=print):
    """Shows until Ctrl-C, or, with a `pid`, until it has ended and nobody looks."""
    page = Page("limphome", port)
    try:
        tell(page.url)
        Live(page, run, pid, joins).watch()
    finally:
        page.stop()
