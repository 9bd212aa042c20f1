"""A crawler's belt as a body, with grousers on it that go round as the belt does."""

import numpy as np

from limphome_lab.robot import belt

GROUSER_HEIGHT = 0.12  # of the belt's radius
PITCH = 0.7  # between grousers, about, of the belt's radius
MARK_EVERY = 4  # grousers; the eye follows the marked ones


class Belt:
    """Shapes in the frame of the base. Travel [m] is positive forward: below, the belt then runs to the rear."""

    def __init__(self, crawler):
        self.crawler = crawler
        radius = crawler["radius"]
        self.height = GROUSER_HEIGHT * radius
        self.run = crawler["length"] / 2 - radius  # half of the straight stretch
        self.middle = radius - self.height / 2  # radius of the middle of the grousers
        self.around = 4 * self.run + 2 * np.pi * self.middle
        self.count = MARK_EVERY * max(1, round(self.around / (PITCH * radius * MARK_EVERY)))
        left = np.array(crawler["axis"], dtype=float)
        self.forward = np.cross(left, (0, 0, 1)) / np.linalg.norm(np.cross(left, (0, 0, 1)))
        self.up = np.cross(self.forward, left)
        self.marked = np.arange(self.count) % MARK_EVERY == 0

    def body(self):
        """([n x 3] vertices, [m x 3] faces) of the belt without its grousers."""
        inner = self.crawler["radius"] - self.height
        narrower = self.crawler | {"length": 2 * (self.run + inner), "radius": inner}
        vertices = belt(narrower)  # in pairs, one on each side
        pairs = len(vertices) // 2
        here, there = 2 * np.arange(pairs), 2 * ((np.arange(pairs) + 1) % pairs)
        tread = np.vstack([np.column_stack([here, here + 1, there]), np.column_stack([there, here + 1, there + 1])])
        fan = np.array([[0, 2 * k, 2 * k + 2] for k in range(1, pairs - 1)])
        return vertices, np.vstack([tread, fan, fan[:, ::-1] + 1])

    def grouser(self):
        """([n x 3] vertices, [m x 3] faces) of one, its length along y, its outside up."""
        size = np.array([0.35 * self.around / self.count, self.crawler["width"], self.height])
        return box(size / 2)

    def grousers(self, travel):
        """([n x 3] positions, [n x 4] quaternions w, x, y, z) of all."""
        way = (np.arange(self.count) * self.around / self.count + travel) % self.around
        straight, turn = 2 * self.run, np.pi * self.middle
        # from above the rear end: forward along the top, round the front, back along the ground, round the rear
        angle = np.interp(way, np.cumsum([0, straight, turn, straight, turn]), [0, 0, np.pi, np.pi, 2 * np.pi])
        on_top = np.clip(way, 0, straight)
        below = np.clip(way - straight - turn, 0, straight)
        x = on_top - below - self.run + self.middle * np.sin(angle)
        z = self.middle * np.cos(angle)
        positions = self.crawler["centre"] + np.outer(x, self.forward) + np.outer(z, self.up)
        # turned about the left axis by as much as the belt has turned; the base's y axis is the left one of the grouser
        half = angle / 2
        left = np.cross(self.up, self.forward)
        return positions, np.column_stack([np.cos(half), np.outer(np.sin(half), left)])


def box(half):
    """([8 x 3] vertices, [12 x 3] faces) round the origin."""
    x, y, z = half
    vertices = np.array([[i * x, j * y, k * z] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return vertices, np.array([triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))])
