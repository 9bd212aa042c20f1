"""The same robot in PyBullet, for speed alone: crawlers as two boxes, or as five wheels each.

Bullet has no belts: boxes are dragged, and wheels turn by velocity motors, so that both carry the machine's masses,
joints and contacts but not its physics."""

import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path

import numpy as np
import pybullet

from limphome_lab.measure.validation.statics import GRAVITY, Machine

WHEELS = 5  # of a crawler


def _collision(link, centre, shape, **numbers):
    collision = xml.SubElement(link, "collision")
    xml.SubElement(collision, "origin", xyz=" ".join(map(str, centre)), rpy=f"{numbers.pop('roll', 0)} 0 0")
    xml.SubElement(xml.SubElement(collision, "geometry"), shape, {name: str(n) for name, n in numbers.items()})


def _urdf(path, wheels):
    """URDF with collision shapes as PyBullet needs them: only crawlers and tip touch, as with us."""
    machine, root = Machine(path), xml.parse(path).getroot()
    links = {link.get("name"): link for link in root.findall("link")}
    for link in links.values():
        for element in link.findall("visual") + link.findall("collision"):
            link.remove(element)
    base = machine.robot.bodies[0]["name"]
    for side, crawler in zip(("left", "right"), machine.crawlers, strict=True):
        flat = crawler.length - 2 * crawler.radius
        if not wheels:
            _collision(links[base], crawler.centre, "box", size=f"{flat} {crawler.width} {2 * crawler.radius}")
            continue
        for i, x in enumerate(np.linspace(-flat / 2, flat / 2, WHEELS)):
            name = f"{side}_wheel_{i}"
            wheel = xml.SubElement(root, "link", name=name)
            inertial = xml.SubElement(wheel, "inertial")
            xml.SubElement(inertial, "mass", value="1")
            xml.SubElement(inertial, "inertia", ixx="0.01", iyy="0.02", izz="0.01", ixy="0", ixz="0", iyz="0")
            _collision(wheel, (0, 0, 0), "cylinder", roll=np.pi / 2, radius=crawler.radius, length=crawler.width)
            joint = xml.SubElement(root, "joint", name=name, type="continuous")
            xml.SubElement(joint, "parent", link=base)
            xml.SubElement(joint, "child", link=name)
            xml.SubElement(joint, "origin", xyz=" ".join(map(str, crawler.centre + [x, 0, 0])))
            xml.SubElement(joint, "axis", xyz="0 1 0")
    body, centre, radius = machine.tip
    _collision(links[machine.robot.bodies[body]["name"]], centre, "sphere", radius=radius)
    root.remove(root.find("limphome"))
    return xml.tostring(root, encoding="unicode")


class PybulletPlant:
    """Steps of 1/240 s and otherwise PyBullet's defaults."""

    time_step = 1 / 240

    def __init__(self, path, wheels):
        self.client = pybullet.connect(pybullet.DIRECT)
        on = {"physicsClientId": self.client}
        pybullet.setGravity(0, 0, -GRAVITY, **on)
        plane = pybullet.createCollisionShape(pybullet.GEOM_PLANE, **on)
        ground = pybullet.createMultiBody(0, plane, **on)
        pybullet.changeDynamics(ground, -1, lateralFriction=1, **on)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "robot.urdf"
            file.write_text(_urdf(path, wheels))
            self.robot = pybullet.loadURDF(str(file), **on)
        joints = {}
        for i in range(pybullet.getNumJoints(self.robot, **on)):
            info = pybullet.getJointInfo(self.robot, i, **on)
            joints[info[1].decode()] = (i, info[10])
            pybullet.changeDynamics(self.robot, i, lateralFriction=0.7, **on)
        pybullet.changeDynamics(self.robot, -1, lateralFriction=0.7, **on)
        self.machine = Machine(path)
        self.joints = joints
        for name, angle in zip(self.machine.robot.arm, self.machine.arm_home, strict=True):
            pybullet.resetJointState(self.robot, joints[name][0], angle, **on)
        self.run(0.5)

    def run(self, seconds, *rates):
        speeds, arm = self.machine.all_rates(rates)
        sprockets = np.array(speeds) / self.machine.crawlers[0].radius
        targets = dict(zip(self.machine.robot.crawlers, sprockets, strict=True))
        targets |= {
            name: targets["left_crawler" if name.startswith("left") else "right_crawler"]
            for name in self.joints
            if "_wheel_" in name
        }
        targets |= dict(zip(self.machine.robot.arm, arm, strict=True))
        for name, rate in targets.items():
            joint, force = self.joints[name]
            pybullet.setJointMotorControl2(
                self.robot,
                joint,
                pybullet.VELOCITY_CONTROL,
                targetVelocity=rate,
                force=force or 1000,
                physicsClientId=self.client,
            )
        for _ in range(round(seconds / self.time_step)):
            pybullet.stepSimulation(physicsClientId=self.client)

    def close(self):
        pybullet.disconnect(self.client)
