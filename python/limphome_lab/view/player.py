"""A page on which recorded episodes are played: a slider of their time, and beside each robot what was decided."""

import queue
import time

import numpy as np

from limphome_lab import paths
from limphome_lab.view import stage, told
from limphome_lab.view.controls import Eye
from limphome_lab.view.panels import Told
from limphome_lab.view.recorded_run import lanes

FRAME_S = 1 / 30
TEXT_S = 0.1  # between two times that text is brought up to date
SPEEDS = {"1/4 x": 0.25, "1/2 x": 0.5, "1 x": 1.0, "2 x": 2.0, "4 x": 4.0, "10 x": 10.0}
TERMS = ("motion", "goal", "stability", "tumble")  # of the reward
PANEL_WIDTH = 380  # [px]
REACH = 20.0  # [m] of the ground's lines
FARTHER = 0.5  # the eye is at first, for each further run
STEP_S = 0.01  # of the slider


class Player:
    """`folders`: of the runs, side by side; `number`: of the episode, None: the last; `speed`: the plant's time to the
    clock's."""

    def __init__(self, page, folders, number=None, speed=1.0):
        self.page = page
        self.time, self.speed, self.playing = 0.0, speed, True
        self._later = queue.SimpleQueue()  # what a person has asked for, done between two frames
        self._told = float("-inf")
        stage.light(page.scene)
        self.runs = lanes(page.scene, folders)
        stage.put_lines(page.scene, [run.ground for run in self.runs], REACH)
        gui = page.gui
        gui.configure_theme(control_width="large", show_logo=False, show_share_button=False, brand_color=(31, 95, 168))
        gui.main_panel.dock_right()
        gui.main_panel.set_width(PANEL_WIDTH)
        self._slider = gui.add_slider("time [s]", 0.0, 1.0, STEP_S, 0.0)
        self._slider.on_update(self._asked(lambda: self.seek(self._slider.value)))
        self._button = gui.add_button("Pause  (P)")
        self._button.on_click(lambda _: self._later.put(self.play_or_pause))
        gui.add_command("Play or pause", hotkey="P").on_trigger(lambda _: self._later.put(self.play_or_pause))
        choice = gui.add_button_group("speed", tuple(SPEEDS))
        choice.on_click(lambda _: self._later.put(lambda: self._go_at(SPEEDS[choice.value])))
        self._pace = gui.add_markdown("")
        self.eye = Eye(page)
        self.eye.follow.value = False
        farther = 1 + FARTHER * (len(self.runs) - 1)
        page.initial_camera.position = farther * np.array(page.initial_camera.position)
        self._panels = [self._panel(gui, run) for run in self.runs]
        for panel in self._panels:
            panel.take(number)
        self._begin()

    def _panel(self, gui, run):
        with gui.add_folder(paths.shown(run.folder.path)):
            panel = RunPanel(gui, run)
        panel.number.on_update(self._asked(lambda: self._take(panel)))
        return panel

    def _asked(self, action):
        """A callback for what a person changes; what the page sets itself is passed over."""
        return lambda event: self._later.put(action) if event.client is not None else None

    def watch(self):
        """Plays until it is interrupted."""
        before = time.monotonic()
        while True:
            while not self._later.empty():
                self._later.get()()
            now = time.monotonic()
            if self.playing:
                self.time = min(self.time + (now - before) * self.speed, self.duration)
                self.playing = self.time < self.duration
            before = now
            self._show(now)
            time.sleep(max(0.0, FRAME_S - (time.monotonic() - now)))

    @property
    def duration(self):
        return max(run.track.duration for run in self.runs)

    def seek(self, moment):
        self.time = min(max(moment, 0.0), self.duration)

    def play_or_pause(self):
        self.playing = not self.playing
        if self.playing and self.time >= self.duration:
            self.time = 0.0

    def _go_at(self, speed):
        self.speed = speed

    def _take(self, panel):
        panel.take(panel.nearest(panel.number.value))
        self._begin()
        self.playing = True

    def _begin(self):
        self.time = 0.0
        self._slider.max = self.duration

    def _show(self, now):
        self.eye.position = self.runs[0].place(self.time)
        with self.page.atomic():
            for run in self.runs:
                self.eye.apply(run.scene)
                run.show(self.time)
        if now - self._told >= TEXT_S:
            self._told = now
            self._slider.value = self.time
            self._button.label = "Pause  (P)" if self.playing else "Play  (P)"
            self._pace.content = f"{self.time:.2f} s of {self.duration:.2f} s, **{self.speed:g} x real time**"
            for panel in self._panels:
                panel.show(self.time)


class RunPanel:
    """What a run tells of the moment that is shown."""

    def __init__(self, gui, run):
        self.run = run
        numbers = run.recording.numbers
        self.number = gui.add_number("episode", numbers[-1], min=numbers[0], max=numbers[-1], step=1)
        self._ending = gui.add_markdown("")
        self._told = Told(gui)

    def nearest(self, number):
        """The recorded episode that is."""
        return min(self.run.recording.numbers, key=lambda recorded: abs(recorded - number))

    def take(self, number):
        self.run.take(number)
        self.number.value = self.run.track.number
        self._ending.content = ending(self.run.track)

    def show(self, moment):
        decision = self.run.track.decision(moment)
        if decision is None:
            self._told.clear()
            return
        self._told.episodes((decision.episode, decision.step), [])
        self._told.decision(self.run.robot, decision, self.run.track.at(moment).health)


def ending(track):
    """How an episode ended, as a table."""
    if track.ending is None:
        return "**under way when the recording ended**"
    end = track.ending
    rows = [
        ("outcome", f"**{track.outcome}**"),
        ("decisions", f"{end.steps}"),
        ("duration", f"{end.duration:.1f} s"),
        ("reward", f"{end.reward:.2f}"),
        *((f"- of {told.spoken(term)}", f"{getattr(end, f'reward_{term}'):.2f}") for term in TERMS),
        ("beside the line", f"{end.lateral_error:+.2f} m"),
        ("change of heading", f"{np.degrees(end.heading_change):+.1f}°"),
    ]
    return told.table(("ended", ""), rows)
