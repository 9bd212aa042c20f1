"""The ground as the simulator has it, in a scene of viser: a plane with a grid, or tiles with their heights.

Heights and loose patches are what limphome-instrument tells of the run's own settings: rough ground is drawn from a
seed and has no end, so tiles are put up where the robot comes to.
"""

import json
import subprocess

import numpy as np

from limphome_lab import describe, paths
from limphome_lab.ending import Ending

TILE = 6.0  # edge of a tile [m]
SPACING = 0.1  # of heights in it [m]
NODES = round(TILE / SPACING) + 1
LINE_EVERY = 10  # spacings between the lines of the grid
REACH = 1  # tiles to each side of the robot's that are put up

FIRM = (214, 205, 190)
LOOSE = (176, 150, 116)
LINE = (150, 140, 124)
SINK = 0.004  # the mesh lies that much below what is drawn on it [m]


def is_plane(settings):
    """Whether the ground of these settings is level, all alike and without end."""
    ground = settings["ground"]
    keys = ("incline_along_rad", "incline_across_rad", "rough_amplitude_m", "step_height_m", "patch_share")
    return all(float(ground[key]) == 0 for key in keys)


class Ground:
    """`config`, `robot`: files of the run; the nodes are put below /NAME, as of a RobotScene."""

    def __init__(self, scene, config, robot, settings, name="robot", packages=None):
        self.scene, self.name = scene, name
        self.command = (
            [
                *(paths.program("instrument"), "--config", config, "--robot", robot),
                *describe.options(packages),
            ]
            if not is_plane(settings)
            else None
        )
        self.tiles = {}  # {(column, row): [NODES x NODES] heights, along y and then x}
        if self.command is None:
            self._add_plane()

    def show_around(self, position):
        """Puts up what is missing round a place [x, y]; returns whether there was anything."""
        if self.command is None:
            return False
        column, row = (int(np.floor(each / TILE)) for each in position[:2])
        near = range(-REACH, REACH + 1)
        missing = [(column + i, row + j) for i in near for j in near if (column + i, row + j) not in self.tiles]
        for tile in missing:
            self._add_tile(*tile)
        return bool(missing)

    @property
    def level(self):
        """Whether it is a plane, whose grid `hide_grid` hides."""
        return self.command is None

    def hide_grid(self):
        if self.level:
            self._grid.visible = False

    def height(self, x, y):
        """[m] of what is put up; 0 elsewhere."""
        tile = int(np.floor(x / TILE)), int(np.floor(y / TILE))
        if tile not in self.tiles:
            return 0.0
        i, j = round((x / TILE - tile[0]) * (NODES - 1)), round((y / TILE - tile[1]) * (NODES - 1))
        return float(self.tiles[tile][j, i])

    def _add_plane(self):
        half = 500.0
        corners = np.array([[-half, -half, 0], [half, -half, 0], [half, half, 0], [-half, half, 0]])
        self.scene.add_mesh_simple(
            f"/{self.name}/ground/plane",
            corners - (0, 0, SINK),
            np.array([[0, 1, 2], [0, 2, 3]]),
            color=FIRM,
            cast_shadow=False,
        )
        self._grid = self.scene.add_grid(
            f"/{self.name}/ground/grid",
            infinite_grid=True,
            cell_size=0.5,
            cell_color=(198, 188, 172),
            section_size=1.0,
            section_color=LINE,
            fade_distance=40,
            shadow_opacity=0,
        )

    def _add_tile(self, column, row):
        x, y = column * TILE, row * TILE
        told = self._ask(x, y)
        heights = np.reshape(told["height"], (NODES, NODES))
        self.tiles[column, row] = heights
        across, along = np.meshgrid(x + SPACING * np.arange(NODES), y + SPACING * np.arange(NODES))
        nodes = np.stack([across, along, heights], axis=-1)
        faces, loose = _faces(np.reshape(told["friction"], (NODES, NODES)))
        path = f"/{self.name}/ground/{column}_{row}"
        for kind, which, colour in (("firm", ~loose, FIRM), ("loose", loose, LOOSE)):
            if which.any():
                self.scene.add_mesh_simple(
                    f"{path}/{kind}", nodes.reshape(-1, 3) - (0, 0, SINK), faces[which], color=colour, cast_shadow=False
                )
        self.scene.add_line_segments(f"{path}/lines", _lines(nodes), LINE, thickness=0.012)

    def _ask(self, x, y):
        words = f"ground {x!r} {y!r} {SPACING!r} {NODES} {NODES}\n"
        result = subprocess.run(self.command, input=words, capture_output=True, text=True)
        if result.returncode != 0:
            raise Ending(result.stderr.strip())
        return json.loads(result.stdout)


def _faces(friction):
    """([n x 3] triangles over the nodes, [n] whether each is loose)"""
    corner = np.arange(NODES * NODES).reshape(NODES, NODES)[:-1, :-1].ravel()
    right, up = corner + 1, corner + NODES
    faces = np.vstack([np.column_stack([corner, right, up + 1]), np.column_stack([corner, up + 1, up])])
    loose = friction[:-1, :-1].ravel() < 1
    return faces, np.concatenate([loose, loose])


def _lines(nodes):
    """[n x 2 x 3] along the ground, every LINE_EVERY nodes, both ways."""
    along, across = nodes[:, ::LINE_EVERY], nodes[::LINE_EVERY]
    segments = [
        np.stack([along[:-1], along[1:]], axis=2).reshape(-1, 2, 3),
        np.stack([across[:, :-1], across[:, 1:]], axis=2).reshape(-1, 2, 3),
    ]
    return np.vstack(segments)
