"""Unit quaternions (w, x, y, z), as in our messages."""

import numpy as np

IDENTITY = np.array([1.0, 0.0, 0.0, 0.0])
NEARLY_ONE = 0.9995  # cosine of half a turn below which two are told apart well enough to divide by its sine


def product(a, b):
    """The turn b, followed by a."""
    (aw, *av), (bw, *bv) = a, b
    return np.array([aw * bw - np.dot(av, bv), *(aw * np.array(bv) + bw * np.array(av) + np.cross(av, bv))])


def about(axis, angle):
    """A turn by `angle` [rad] about the unit vector `axis`."""
    return np.array([np.cos(angle / 2), *(np.sin(angle / 2) * np.asarray(axis, dtype=float))])


def slerp(a, b, share):
    """From a (share 0) to b (share 1) at a constant rate about one axis, the shorter way round."""
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    cosine = np.dot(a, b)
    if cosine < 0:
        b, cosine = -b, -cosine
    if cosine > NEARLY_ONE:
        mixed = a + share * (b - a)
        return mixed / np.linalg.norm(mixed)
    angle = np.arccos(cosine)
    return (np.sin((1 - share) * angle) * a + np.sin(share * angle) * b) / np.sin(angle)


def heading(quaternion):
    """Angle of the turned x axis from the x axis, seen from above [rad]."""
    w, x, y, z = quaternion
    return np.arctan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z))
