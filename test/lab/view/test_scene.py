"""The robot in a scene of viser: what has failed is red, and nothing else."""

import numpy as np
import pytest
import viser

from limphome import robot_state_t
from limphome_lab import paths, robot
from limphome_lab.show.figures import style
from limphome_lab.view.frame import Frame
from limphome_lab.view.scene import RobotScene, rgb


@pytest.fixture
def scene():
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    yield RobotScene(server.scene, robot.read(paths.ROOT / "config" / "crawler.urdf"))
    server.stop()


def test_what_has_failed_is_red(scene):
    health = np.array([robot_state_t.FAILED, *[robot_state_t.OBEYS] * 4])
    scene.show(Frame(0.0, 1, np.zeros(3), np.array([1.0, 0, 0, 0]), np.zeros(5), health))
    failed, sound = ({tuple(handle.color) for handle, _ in scene._coloured[actuator]} for actuator in (0, 1))
    assert failed == {tuple(rgb(style.RED))} and failed.isdisjoint(sound)
