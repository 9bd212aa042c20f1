"""Robots that differ from the paper's in some numbers, as URDF files of their own."""

import tempfile
import xml.etree.ElementTree as xml
from contextlib import contextmanager
from pathlib import Path

from limphome_lab.measure.instrument import CRAWLER


@contextmanager
def changed_robot(changes):
    """File of the paper's robot with `changes`: {XPath of elements: {attribute: value}}."""
    tree = xml.parse(CRAWLER)
    for path, attributes in changes.items():
        elements = tree.findall(path)
        if not elements:
            raise KeyError(f"{CRAWLER.name} has no {path}")
        for element in elements:
            for name, value in attributes.items():
                element.set(name, str(value))
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "robot.urdf"
        tree.write(file)
        yield file


def base_centre_at(x, y):
    """The base's centre of mass moved to (x, y); a little over half the robot's mass."""
    return {"link[@name='base']/inertial/origin": {"xyz": f"{x} {y} 0.30"}}


def torque_limits(torque, *joints):
    return {f"joint[@name='{joint}']/limit": {"effort": torque} for joint in joints}
