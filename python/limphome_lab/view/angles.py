"""Where the eye of a video is: as near as it can be from its side with the robot in the picture all the time."""

from dataclasses import dataclass

import numpy as np
from viser.transforms import SO3

FIELD_OF_VIEW = np.radians(35)  # from top to bottom
MARGIN = 0.06  # of the picture that stays empty at each edge

# towards the eye; the robot begins at the origin and faces +y. Seen from the side of what has failed: x is mirrored
# where that is on the right
SIDES = {
    "corner": (-1.0, 0.75, 0.5),
    "side": (-1.0, 0.0, 0.12),
    "front": (0.0, 1.0, 0.3),
    "behind": (0.0, -1.0, 0.4),
    "above": (0.0, -0.001, 1.0),
}
FOLLOWED = "follow"  # from the corner, keeping up with the robot
ANGLES = (*SIDES, FOLLOWED)


@dataclass
class Eye:
    position: np.ndarray  # [3]
    wxyz: np.ndarray  # of the camera: z ahead, y down


def towards(name, mirrored):
    """Unit vector from what is looked at to the eye."""
    x, y, z = SIDES["corner" if name == FOLLOWED else name]
    direction = np.array([-x if mirrored else x, y, z])
    return direction / np.linalg.norm(direction)


def looking(direction):
    """[3x3] axes of a camera that looks against `direction`, as columns: right, down, ahead."""
    right = np.cross(-direction, (0, 0, 1))
    right /= np.linalg.norm(right)
    return np.column_stack([right, np.cross(-direction, right), -direction])


def fitted(direction, points, width_to_height):
    """The nearest Eye in that direction that has all [n x 3] points in its picture."""
    axes = looking(direction)
    x, y, ahead = (points @ axes).T
    up = np.tan(FIELD_OF_VIEW / 2) * (1 - 2 * MARGIN)
    # |x - cx| <= across (ahead - ce) and the same of y: the planes of the picture's edges, moved until all lies within
    edges = [_edges(values, ahead, slope) for values, slope in ((x, up * width_to_height), (y, up))]
    depths, middles = zip(*edges, strict=True)
    at = np.array([*middles, min(depths)])
    return Eye(axes @ at, SO3.from_matrix(axes).wxyz)


def _edges(values, ahead, slope):
    """(depth of an eye from which all lies between two edges of that slope, where between them it is)"""
    low, high = (values + slope * ahead).min(), (values - slope * ahead).max()
    return (low - high) / (2 * slope), (low + high) / 2
