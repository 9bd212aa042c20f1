"""The robot and what belongs to it, in a scene of viser.

A page can hold several: each has a name and an offset of its own, and all of it hangs on the node /NAME, in the world
frame of its plant.
"""

import numpy as np
from viser import transforms

from limphome import robot_state_t
from limphome_lab.robot import rotation_of
from limphome_lab.show.figures import outline, style
from limphome_lab.view.belt import Belt

# Colours that those tell apart, too, who see no difference of red and green (Okabe and Ito)
MARGIN_COLOURS = np.array([(213, 94, 0), (240, 228, 66), (0, 114, 178)])  # of no margin, little and enough
MARGIN_ENOUGH = 0.2  # [m]
FORCE = (0, 158, 115)
TRAIL = (31, 95, 168)
GOAL = (58, 143, 77)
CENTRE_OF_MASS = (250, 250, 250)
RIM = (200, 50, 43)

METRES_PER_WEIGHT = 0.8  # an arrow as long as the robot's weight would be [m]
LEAST_FORCE = 0.01  # of the weight; smaller ones are not shown
TRAIL_STEP = 0.03  # [m] between its points
TRAIL_MOST = 400  # points
JUMP = 0.5  # [m] between two frames: the robot was put elsewhere, and a new trail begins
ABOVE_GROUND = 0.012  # [m] at which flat things are drawn
MOST_CORNERS = 24  # of the support polygon, as in ground_truth_t

GOAL_PIECES = 20  # that follow the ground
GLASS = 0.35  # opacity

LAYERS = ("trail", "goal line", "support polygon", "centre of mass", "contact forces", "labels")
GRAVITY = 9.81  # [m/s^2]


class RobotScene:
    """`scene`: server.scene; `robot`: of limphome_lab.robot; `offset` [3] of its plant's world in the page's."""

    def __init__(self, scene, robot, name="robot", offset=(0, 0, 0)):
        self.scene, self.robot, self.name = scene, robot, name
        self.frame = None  # shown last
        self.shown = dict.fromkeys(LAYERS, True)
        self.follow = False  # keeps the robot at the offset and moves the world under it, so that the eye can stay
        self._root = scene.add_frame(f"/{name}", show_axes=False)
        self.place(offset)
        # what is drawn by its corners comes a moment later than where a node is: corners are those from the robot
        self._here = scene.add_frame(self._path("here"), show_axes=False)
        self._bodies = [
            scene.add_frame(self._path(f"body{index}"), show_axes=False) for index in range(len(robot.bodies))
        ]
        self._solids = []
        self._coloured = {}  # {actuator: [(handle, its colour where all is well)]}
        for index, shape in enumerate(robot.told["shapes"]):
            self._add_shape(index, shape)
        self._belts = [self._add_belt(*each) for each in enumerate(robot.told["crawlers"])]
        self._labels = {}  # {actuator: its "failed"}
        self._trail = []
        self._add_layers()

    def place(self, offset, turn=(1, 0, 0, 0), origin=(0, 0, 0)):
        """Puts `origin` [3] of its plant's world at `offset` in the page's, turned by `turn` (w, x, y, z)."""
        self._offset, self._turn, self._origin = np.asarray(offset, dtype=float), rotation_of(turn), np.asarray(origin)
        self._root.wxyz = np.asarray(turn, dtype=float)
        self._place_root()

    def _place_root(self):
        at = self.frame.position * (1, 1, 0) if self.follow and self.frame is not None else self._origin
        self._root.position = self._offset - self._turn @ at

    def show(self, frame, trail=None):
        """Moves all of it to a frame. `trail`: [positions] up to there; where none is given, what has been shown."""
        jumped = self.frame is None or np.linalg.norm(frame.position - self.frame.position) > JUMP
        if trail is not None:
            self._trail = [position + (0, 0, ABOVE_GROUND) for position in trail]
        elif jumped or frame.session != self.frame.session:
            self._trail = []
        self.frame = frame
        self._place_root()
        self._here.position = frame.position
        for handle, pose in zip(
            self._bodies,
            self.robot.frames(frame.actuator_position, frame.position, frame.orientation),
            strict=True,
        ):
            handle.position = pose[:3, 3]
            handle.wxyz = transforms.SO3.from_matrix(pose[:3, :3]).wxyz
        for (belt, grousers), travel in zip(self._belts, frame.actuator_position, strict=False):
            grousers.batched_positions, grousers.batched_wxyzs = belt.grousers(travel)
        self._tell_health(frame.health)
        self._show_trail()
        self._show_support()
        self._show_centre_of_mass()
        self._show_forces()

    def set_goal(self, point, direction, height=lambda x, y: 0.0, half_width=1.0):
        """The goal line goes through `point` [x, y], across `direction` [rad from the world's x axis], on the ground of
        that `height`."""
        across = np.array([-np.sin(direction), np.cos(direction)])
        posts = [np.asarray(point) + side * across for side in np.linspace(-half_width, half_width, GOAL_PIECES + 1)]
        line = np.array([[x, y, height(x, y) + ABOVE_GROUND] for x, y in posts])
        self._goal.points = np.stack([line[:-1], line[1:]], axis=1)
        self._goal.visible = self.shown["goal line"]

    def clear_trail(self):
        self._trail = []
        self._show_trail()

    def set_shown(self, layer, shown):
        """One of LAYERS."""
        self.shown[layer] = shown
        for handle in self._layers[layer]:
            handle.visible = shown

    def set_glass(self, glass):
        """Whether what lies behind the robot is seen through it."""
        for handle in self._solids:
            handle.opacity = GLASS if glass else None

    def remove(self):
        self._root.remove()

    def _path(self, name):
        return f"/{self.name}/{name}"

    def _add_shape(self, index, shape):
        part = self.robot.parts[index]  # in the order of the shapes
        colour = outline.colour(self.robot, part)
        x, y, z = shape["half_size"]
        placed = {"position": shape["position"], "wxyz": shape["rotation"], "color": rgb(colour)}
        path = self._path(f"body{shape['body']}/shape{index}")
        if shape["kind"] == "box":
            handle = self.scene.add_box(path, dimensions=(2 * x, 2 * y, 2 * z), **placed)
        elif shape["kind"] == "cylinder":
            handle = self.scene.add_cylinder(path, radius=x, height=2 * z, **placed)
        else:
            handle = self.scene.add_icosphere(path, radius=x, **placed)
        if shape["body"] > 0:
            self._coloured.setdefault(shape["body"] - 1, []).append((handle, colour))
        self._solids.append(handle)

    def _add_belt(self, index, crawler):
        belt = Belt(crawler)
        path = self._path(f"body0/belt{index}")
        vertices, faces = belt.body()
        body = self.scene.add_mesh_simple(path, vertices, faces, color=rgb(outline.CRAWLER), flat_shading=True)
        positions, turns = belt.grousers(0)
        grousers = self.scene.add_batched_meshes_simple(
            f"{path}/grousers",
            *belt.grouser(),
            batched_wxyzs=turns,
            batched_positions=positions,
            batched_colors=np.where(belt.marked[:, None], (225, 225, 225), (24, 28, 32)).astype(np.uint8),
            flat_shading=True,
            lod="off",
        )
        self._coloured.setdefault(index, []).append((body, outline.CRAWLER))
        self._solids += [body, grousers]
        return belt, grousers

    def _tell_health(self, health):
        for actuator, state in enumerate(health):
            failed = state == robot_state_t.FAILED
            for handle, colour in self._coloured.get(actuator, []):
                handle.color = rgb(style.RED if failed else colour)
            if failed and actuator not in self._labels:
                self._labels[actuator] = self._add_label(actuator)
                self._layers["labels"].append(self._labels[actuator])
            if actuator in self._labels:
                self._labels[actuator].visible = failed and self.shown["labels"]

    def _add_label(self, actuator):
        crawler = actuator < len(self.robot.crawlers)
        above = np.array(self.robot.told["crawlers"][actuator]["centre"]) + (0, 0, 0.3) if crawler else (0, 0, 0.2)
        body = 0 if crawler else actuator + 1
        words = f"{self.robot.actuators[actuator].replace('_', ' ')} failed"
        return self.scene.add_label(self._path(f"body{body}/failed{actuator}"), words, position=above)

    def _add_layers(self):
        nothing = np.zeros((1, 2, 3))
        add = self.scene
        trail = add.add_line_segments(self._path("trail"), nothing, TRAIL, thickness=0.025)
        self._goal = add.add_line_segments(self._path("goal"), nothing, GOAL, thickness=0.06, visible=False)
        corners = np.zeros((MOST_CORNERS, 3))
        fan = np.array([[0, k, k + 1] for k in range(1, MOST_CORNERS - 1)])
        area = add.add_mesh_simple(
            self._path("here/support"),
            corners,
            fan,
            opacity=0.45,
            side="double",
            cast_shadow=False,
            receive_shadow=False,
        )
        edge = add.add_line_segments(self._path("here/support_edge"), nothing, (0, 0, 0), thickness=0.02)
        ball = add.add_icosphere(self._path("here/mass"), radius=0.06, color=CENTRE_OF_MASS)
        plumb = add.add_line_segments(self._path("here/plumb"), nothing, RIM, thickness=0.015)
        foot = add.add_cylinder(self._path("here/foot"), radius=0.05, height=0.01, color=RIM)
        forces = add.add_arrows(self._path("here/forces"), nothing, FORCE, shaft_radius=0.018, head_radius=0.045)
        self._layers = dict(
            zip(LAYERS, ([trail], [self._goal], [area, edge], [ball, plumb, foot], [forces], []), strict=True)
        )

    def _ground_level(self):
        return 0.0 if self.frame is None else self.frame.position[2]

    def _show_trail(self):
        (handle,) = self._layers["trail"]
        if self.frame is not None and not self._trail_is_at(self.frame.position):
            self._trail = [*self._trail[-TRAIL_MOST:], self.frame.position + (0, 0, ABOVE_GROUND)]
        points = np.array(self._trail)
        handle.visible = self.shown["trail"] and len(points) > 1
        if len(points) > 1:
            handle.points = np.stack([points[:-1], points[1:]], axis=1)

    def _trail_is_at(self, position):
        return bool(self._trail) and np.linalg.norm(self._trail[-1] - position) < TRAIL_STEP

    def _show_support(self):
        area, edge = self._layers["support polygon"]
        support = self.frame.support
        there = support is not None and len(support) > 2
        area.visible = edge.visible = self.shown["support polygon"] and there
        if not there:
            return
        corners = np.asarray(support)[:MOST_CORNERS] + (0, 0, ABOVE_GROUND) - self.frame.position
        area.vertices = np.vstack([corners, np.repeat(corners[-1:], MOST_CORNERS - len(corners), axis=0)])
        edge.points = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
        area.color = margin_colour(self.frame.margin)
        edge.colors = np.array(area.color, dtype=np.uint8)

    def _show_centre_of_mass(self):
        ball, plumb, foot = self._layers["centre of mass"]
        centre = self.frame.centre_of_mass
        ball.visible = plumb.visible = foot.visible = self.shown["centre of mass"] and centre is not None
        if centre is None:
            return
        support = self.frame.support
        level = self._ground_level() if support is None or not len(support) else np.mean(support, axis=0)[2]
        below = np.array([centre[0], centre[1], level + ABOVE_GROUND]) - self.frame.position
        centre = centre - self.frame.position
        ball.position, foot.position = centre, below
        plumb.points = np.array([[centre, below]])

    def _show_forces(self):
        (handle,) = self._layers["contact forces"]
        weight = self.robot.told["mass"] * GRAVITY
        force, point = (
            np.reshape([] if each is None else each, (-1, 3))
            for each in (self.frame.contact_force, self.frame.contact_point)
        )
        felt = np.linalg.norm(force, axis=1) > LEAST_FORCE * weight
        handle.visible = self.shown["contact forces"] and bool(felt.any())
        if felt.any():
            at = point[felt] - self.frame.position
            handle.points = np.stack([at, at + METRES_PER_WEIGHT / weight * force[felt]], axis=1)


def margin_colour(margin):
    """[3] of a stability margin [m], from 0 to 255."""
    share = np.clip((margin or 0.0) / MARGIN_ENOUGH, 0, 1) * (len(MARGIN_COLOURS) - 1)
    return tuple(int(np.interp(share, range(len(MARGIN_COLOURS)), channel)) for channel in np.transpose(MARGIN_COLOURS))


def rgb(colour):
    """(r, g, b) of '#rrggbb'."""
    return tuple(bytes.fromhex(colour[1:]))
