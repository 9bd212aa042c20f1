"""A recorded run on a page: one of its episodes, begun at the page's origin and facing +y, at a moment of it."""

import numpy as np

from limphome_lab import quaternion, robot
from limphome_lab.goal import goal
from limphome_lab.view.ground import Ground
from limphome_lab.view.recorded import Recording
from limphome_lab.view.scene import RobotScene

LANE = 1.7  # from one robot to the next, in reaches of the arm


class RecordedRun:
    """`scene`: of a page; `lane`: how far to the right it is shown [m]; `told`: how it is called there, if at all."""

    def __init__(self, scene, folder, name="robot", lane=0.0, told=None):
        self.folder = folder
        self.robot = robot.read(folder.robot)
        self.recording = Recording(folder.messages, self.robot)
        self.scene = RobotScene(scene, self.robot, name)
        self.ground = Ground(scene, folder.config, folder.robot, folder.settings(), name)
        self.lane = np.array([lane, 0, 0])
        if told:
            scene.add_label(f"/{name}_name", told, position=self.lane + (0, -1.5, 0))
        self.track = None

    def take(self, number=None):
        """Shows that episode, None: the last that ended, from its begin on."""
        self.track = track = self.recording.episode(number)
        begin = track.states[0]
        direction = quaternion.heading(begin.orientation)
        if track.decisions[0]:
            point, direction = goal(track.decisions[0], begin)
        self.turn = quaternion.about((0, 0, 1), np.pi / 2 - direction)
        self.begin = np.array([*begin.position[:2], 0])
        self.scene.place(self.lane, self.turn, self.begin)
        self.show(0.0)
        if track.decisions[0]:
            self.scene.set_goal(point, direction, self.ground.height)

    def show(self, time):
        """At a time from the episode's begin [s]."""
        frame = self.track.at(time)
        self.ground.show_around(frame.position)
        trail = [np.array([x, y, self.ground.height(x, y)]) for x, y, _ in self.track.trail(time)]
        self.scene.show(frame, trail)

    def place(self, time):
        """[3] of the body in the page, at a time, level with the ground."""
        return self._in_page(self.track.at(time).position) * (1, 1, 0)

    def corners(self, time):
        """[n x 3] points of the robot in the page, at a time."""
        frame = self.track.at(time)
        parts = self.robot.posed(frame.position, frame.orientation, frame.actuator_position)
        return self._in_page(np.vstack([part.points for part in parts]))

    def _in_page(self, points):
        """Points [3] or [n x 3] of the plant's world."""
        return self.lane + (points - self.begin) @ robot.rotation_of(self.turn).T


def lanes(scene, folders):
    """RecordedRun of each folder, side by side."""
    if len(folders) == 1:
        return [RecordedRun(scene, folders[0])]
    reach = max(reach_of(robot.read(folder.robot)) for folder in folders)
    middle = (len(folders) - 1) / 2
    return [
        RecordedRun(scene, folder, f"robot{index}", (index - middle) * LANE * reach, folder.path.name)
        for index, folder in enumerate(folders)
    ]


def reach_of(described):
    """Of the longest arm, else half of the robot's length [m]."""
    length = max(crawler["length"] for crawler in described.told["crawlers"])
    return max([length / 2, *(tip["reach"] for tip in described.told["tips"])])
