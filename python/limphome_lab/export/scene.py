"""The robot of a recording for a 3D panel: its solids once for each session or failure, its frames with every state."""

import numpy as np

from limphome_lab import quaternion
from limphome_lab.export import foxglove
from limphome_lab.goal import goal
from limphome_lab.robot import Part
from limphome_lab.show.figures import outline, style

WORLD = "world"
GOAL_WIDTH = 2.0  # [m]
LINE_THICKNESS = 0.03  # [m]


class Scene:
    def __init__(self, robot):
        self.robot = robot

    def solids(self, time, state):
        """foxglove.SceneUpdate: an entity for each body and each belt; what has failed is red."""
        when = foxglove.time(time)
        failed = {
            name for name, health in zip(self.robot.actuators, state.actuator_health, strict=False) if health != 0
        }
        entities = [self._body(when, index, failed) for index in range(len(self.robot.bodies))]
        belts = zip(self.robot.crawlers, self.robot.told["crawlers"], strict=True)
        entities += [self._belt(when, name, crawler, failed) for name, crawler in belts]
        return {"deletions": [], "entities": entities}

    def _body(self, when, index, failed):
        name = self.robot.bodies[index]["name"]
        found = {"box": [], "sphere": [], "cylinder": []}
        for shape in self.robot.told["shapes"]:
            if shape["body"] == index:
                shade = self._shade(shape["name"], index, failed)
                where = foxglove.pose(shape["position"], shape["rotation"])
                make = foxglove.cylinder if shape["kind"] == "cylinder" else foxglove.solid
                found[shape["kind"]].append(make(where, 2 * np.array(shape["half_size"]), shade))
        solids = {"cubes": found["box"], "spheres": found["sphere"], "cylinders": found["cylinder"]}
        return foxglove.entity(when, name, name, **solids)

    def _belt(self, when, name, crawler, failed):
        """A box between two cylinders across."""
        length, width, radius = (crawler[key] for key in ("length", "width", "radius"))
        across = np.array(crawler["axis"])
        facing = quaternion.about((0, 0, 1), np.arctan2(-across[0], across[1]))
        along = np.cross(across, (0, 0, 1)) * (length / 2 - radius)
        lying = quaternion.product(facing, quaternion.about((1, 0, 0), -np.pi / 2))  # z becomes the axis
        shade = self._shade(name, 0, failed)
        box = foxglove.solid(foxglove.pose(crawler["centre"], facing), (length - 2 * radius, width, 2 * radius), shade)
        ends = [
            foxglove.cylinder(foxglove.pose(crawler["centre"] + end, lying), (2 * radius, 2 * radius, width), shade)
            for end in (along, -along)
        ]
        return foxglove.entity(when, self.robot.bodies[0]["name"], name, cubes=[box], cylinders=ends)

    def _shade(self, name, body, failed):
        return foxglove.colour(outline.colour(self.robot, Part(name, None, body), failed))

    def frames(self, time, state):
        """foxglove.FrameTransforms of the bodies; sprockets, of which nothing is seen, stay unturned."""
        when = foxglove.time(time)
        base, *others = self.robot.bodies
        transforms = [foxglove.transform(when, WORLD, base["name"], state.position, state.orientation)]
        for actuator, body in enumerate(others):
            turned = body["rotation"]
            if actuator >= len(self.robot.crawlers):
                joint = quaternion.about(body["axis"], state.actuator_position[actuator])
                turned = quaternion.product(turned, joint)
            parent = self.robot.bodies[body["parent"]]["name"]
            transforms.append(foxglove.transform(when, parent, body["name"], body["position"], turned))
        return {"transforms": transforms}


def goal_line(time, decision, state):
    """foxglove.SceneUpdate: the goal line of the episode of that decision."""
    point, direction = goal(decision, state)
    across = GOAL_WIDTH / 2 * np.array([-np.sin(direction), np.cos(direction)])
    drawn = foxglove.line(
        [(*end, 0) for end in (point - across, point + across)], LINE_THICKNESS, foxglove.colour(style.GREEN)
    )
    return {"deletions": [], "entities": [foxglove.entity(foxglove.time(time), WORLD, "goal", lines=[drawn])]}


def path(time, states):
    """foxglove.PosesInFrame: where the body was."""
    poses = [foxglove.pose(state.position, state.orientation) for state in states]
    return {"timestamp": foxglove.time(time), "frame_id": WORLD, "poses": poses}
