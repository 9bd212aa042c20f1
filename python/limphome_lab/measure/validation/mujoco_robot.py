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
    actuators = xml.SubElement(model, "actuator")
    elements = []
    for index, body in enumerate(machine.robot.bodies):
        parent = world if index == 0 else elements[body["parent"]]
        element = xml.SubElement(
            parent, "body", name=body["name"], pos=_text(body["position"]), quat=_text(body["rotation"])
        )
        elements.append(element)
        if index > len(machine.crawlers):
            _add_joint(element, actuators, body, machine.robot.told["actuators"][index - 1])
        _add_inertial(element, body)
    base = elements[0]
    base.set("quat", _text([math.cos(heading / 2), 0, 0, math.sin(heading / 2)]))
    xml.SubElement(base, "freejoint")
    for name, crawler in zip(machine.robot.crawlers, machine.crawlers, strict=True):
        half = [crawler.length / 2 - crawler.radius, crawler.width / 2, crawler.radius]
        xml.SubElement(
            base, "geom", name=name, type="box", pos=_text(crawler.centre), size=_text(half), surfacevel="1 0 0 0 0 0"
        )  # all 0 would switch it off for good
    body, centre, radius = machine.tip
    xml.SubElement(elements[body], "geom", name="tip", type="sphere", pos=_text(centre), size=repr(radius))
    return xml.tostring(model, encoding="unicode")


def _add_joint(element, actuators, body, actuator):
    name, force, limits = actuator["name"], actuator["effort"], _text([actuator["lower"], actuator["upper"]])
    xml.SubElement(element, "joint", name=name, axis=_text(body["axis"]), limited="true", range=limits)
    xml.SubElement(
        actuators,
        "intvelocity",
        name=name,
        joint=name,
        kp=str(ARM_STIFFNESS),
        kv=str(ARM_DAMPING),
        actrange=limits,
        forcerange=f"{-force} {force}",
    )


def _add_inertial(element, body):
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = body["inertia"]
    xml.SubElement(
        element,
        "inertial",
        pos=_text(body["centre"]),
        mass=repr(body["mass"]),
        fullinertia=_text([xx, yy, zz, xy, xz, yz]),
    )


class MujocoPlant:
    """Drives the model as Instrument drives ours, as far as the comparison needs it."""

    def __init__(self, path, **options):
        self.machine = Machine(path)
        self.base = self.machine.robot.bodies[0]["name"]
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
        axes = self.data.body(self.base).xmat.reshape(3, 3)
        return math.atan2(axes[1, 0], axes[0, 0])

    @property
    def position(self):
        return self.data.body(self.base).xpos.copy()

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
