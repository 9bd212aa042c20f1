"""The same robot in MuJoCo: masses, joints, torque limits and points of contact from the URDF.

A crawler is a box whose lower corners are the ends of the flat part of the belt; its belt is the box's surface
velocity, which MuJoCo prescribes whatever the load. A sprocket's inertia therefore has no place in it."""

import math
import xml.etree.ElementTree as xml

import mujoco
import numpy as np

from limphome_lab.measure.validation.statics import GRAVITY, Machine

ARM_STIFFNESS = 1e6  # of the arm's servos [N m/rad]
ARM_DAMPING = 1e5  # [N m s/rad]

# MuJoCo's own defaults, and a round cone with stiffer friction.
DEFAULTS = {"cone": "pyramidal", "impratio": 1}
ELLIPTIC = {"cone": "elliptic", "impratio": 10}


def _text(numbers):
    return " ".join(f"{number:.12g}" for number in np.ravel(numbers))


def model_xml(path, friction=0.7, time_step=1 / 240, options=ELLIPTIC, solref=(0.02, 1), heading=math.pi / 2):
    """MJCF of the robot in the file `path`; `solref` is the ground's time constant [s] and damping ratio."""
    machine = Machine(path)
    root = xml.parse(path).getroot()
    links = {link.get("name"): link for link in root.findall("link")}
    limits = {joint.get("name"): joint.find("limit") for joint in root.findall("joint")}
    model = xml.Element("mujoco")
    xml.SubElement(
        model,
        "option",
        timestep=repr(time_step),
        gravity=f"0 0 {-GRAVITY}",
        integrator="implicitfast",
        **{name: str(value) for name, value in options.items()},
    )
    xml.SubElement(
        xml.SubElement(model, "default"), "geom", friction=f"{friction} 0 0", condim="3", solref=_text(solref)
    )
    xml.SubElement(model, "compiler", angle="radian", inertiafromgeom="false")
    world = xml.SubElement(model, "worldbody")
    xml.SubElement(world, "geom", name="ground", type="plane", size="0 0 1", contype="2", conaffinity="1")
    bodies = {
        machine.robot.base: xml.SubElement(
            world, "body", name=machine.robot.base, quat=_text([math.cos(heading / 2), 0, 0, math.sin(heading / 2)])
        )
    }
    base = bodies[machine.robot.base]
    xml.SubElement(base, "freejoint")
    _add_inertial(base, links[machine.robot.base])
    actuators = xml.SubElement(model, "actuator")
    for joint in machine.robot.joints:
        rotation = np.zeros(4)
        mujoco.mju_mat2Quat(rotation, joint.origin[:3, :3].ravel())
        body = xml.SubElement(
            bodies[joint.parent], "body", name=joint.child, pos=_text(joint.origin[:3, 3]), quat=_text(rotation)
        )
        bodies[joint.child] = body
        if joint.name in machine.robot.arm:
            limit = limits[joint.name]
            xml.SubElement(
                body,
                "joint",
                name=joint.name,
                axis=_text(joint.axis),
                limited="true",
                range=f"{limit.get('lower')} {limit.get('upper')}",
            )
            force = float(limit.get("effort"))
            xml.SubElement(
                actuators,
                "intvelocity",
                name=joint.name,
                joint=joint.name,
                kp=str(ARM_STIFFNESS),
                kv=str(ARM_DAMPING),
                actrange=f"{limit.get('lower')} {limit.get('upper')}",
                forcerange=f"{-force} {force}",
            )
        _add_inertial(body, links[joint.child])
    for name, crawler in zip(machine.robot.crawlers, machine.crawlers, strict=True):
        half = [crawler.length / 2 - crawler.radius, crawler.width / 2, crawler.radius]
        xml.SubElement(
            base, "geom", name=name, type="box", pos=_text(crawler.centre), size=_text(half), surfacevel="1 0 0 0 0 0"
        )  # all 0 would switch it off for good
    link, centre, radius = machine.tip
    xml.SubElement(bodies[link], "geom", name="tip", type="sphere", pos=_text(centre), size=repr(radius))
    return xml.tostring(model, encoding="unicode")


def _add_inertial(body, link):
    inertial = link.find("inertial")
    origin = inertial.find("origin")
    moments = inertial.find("inertia")
    xml.SubElement(
        body,
        "inertial",
        pos="0 0 0" if origin is None else origin.get("xyz"),
        mass=inertial.find("mass").get("value"),
        diaginertia=_text([float(moments.get(name)) for name in ("ixx", "iyy", "izz")]),
    )


class MujocoPlant:
    """Drives the model as Instrument drives ours, as far as the comparison needs it."""

    def __init__(self, path, **options):
        self.machine = Machine(path)
        self.model = mujoco.MjModel.from_xml_string(model_xml(path, **options))
        self.data = mujoco.MjData(self.model)
        self.data.qpos[7:] = self.machine.arm_home  # after the base's position and orientation
        self.data.act[:] = self.machine.arm_home
        self.crawlers = [self.model.geom(name).id for name in self.machine.robot.crawlers]
        self.tip = self.model.geom("tip").id
        self.run(0.5)

    def run(self, seconds, *rates):
        speeds, self.data.ctrl[:] = self.machine.all_rates(rates)
        for geom, speed in zip(self.crawlers, speeds, strict=True):
            self.model.geom_surfacevel[geom][0] = -speed  # the surface runs back under the robot
        mujoco.mj_step(self.model, self.data, nstep=round(seconds / self.model.opt.timestep))

    @property
    def heading(self):
        axes = self.data.body(self.machine.robot.base).xmat.reshape(3, 3)
        return math.atan2(axes[1, 0], axes[0, 0])

    @property
    def position(self):
        return self.data.body(self.machine.robot.base).xpos.copy()

    def mean_drive_torque(self, crawler, seconds):
        """What the friction on a belt asks of its sprocket, mean over time as contacts may chatter [N m]."""
        steps = round(seconds / self.model.opt.timestep)
        total = 0.0
        for _ in range(steps):
            mujoco.mj_step(self.model, self.data)
            along = [math.cos(self.heading), math.sin(self.heading), 0]
            total += self.force(self.crawlers[crawler]) @ along
        return self.machine.crawlers[crawler].radius * total / steps

    def mean_loaded_corners(self, seconds):
        """Of the crawlers, mean over time; a robot that stands on them has eight."""
        steps = round(seconds / self.model.opt.timestep)
        loaded = 0
        for _ in range(steps):
            mujoco.mj_step(self.model, self.data)
            for i in range(self.data.ncon):
                force = np.zeros(6)
                mujoco.mj_contactForce(self.model, self.data, i, force)
                loaded += force[0] > 1
        return loaded / steps

    def force(self, geom):
        """Of the ground on a part of the robot [N]."""
        result = np.zeros(3)
        for i, contact in enumerate(self.data.contact):
            if geom in (contact.geom1, contact.geom2):
                force = np.zeros(6)
                mujoco.mj_contactForce(self.model, self.data, i, force)
                sign = 1 if geom == contact.geom2 else -1
                result += sign * contact.frame.reshape(3, 3).T @ force[:3]
        return result
