#!/usr/bin/env python3
"""Prints reference.h: the paper's equations in 40 digits, for the tests of liblimphome.

    python3 reference.py > reference.h

It shares nothing with the library but the equations: 4x4 matrices for quaternions, a brute-force rotation for the
formula of the stability margin, central differences for the gradient. Inputs are rounded to single precision before
use, so that both sides see the same numbers. The seed is fixed; the output is committed, and scripts/test makes it
again.
NumPy only draws and arranges the numbers: its exp, sin and linear algebra differ in the last bits, and eigenvectors in
sign, from processor to processor. mpmath's do not.
"""

import itertools
import pathlib
import textwrap
import xml.etree.ElementTree

import mpmath
import numpy as np
from mpmath import mpf

HERE = pathlib.Path(__file__).resolve().parent
mpmath.mp.dps = 40
rng = np.random.default_rng(20190918)
lines = []


exact = np.vectorize(mpf, otypes=[object])
exp = np.vectorize(mpmath.exp, otypes=[object])


def single(values):
    """Rounded to single precision, held in 40 digits."""
    return exact(np.asarray(values, dtype=np.float32).astype(np.float64))[()]


def emit(kind, name, values, comment):
    values = np.asarray(values)
    shape = "".join(f"[{n}]" for n in values.shape)
    form = {"float": "{:.9g}", "double": "{:.17g}"}.get(kind, "{}")

    def text(v):
        if isinstance(v, np.ndarray):
            return "{" + ", ".join(text(x) for x in v) + "}"
        number = form.format(float(v) if isinstance(v, mpf) else v)
        if kind == "float":
            number += ("" if any(c in number for c in ".e") else ".") + "f"
        return number + ("u" if kind == "uint32_t" else "")

    rows = textwrap.indent(textwrap.fill(text(values)[1:-1], 114, break_long_words=False), "    ")
    lines.append(f"/* {comment} */\nstatic const {kind} {name}{shape} = {{\n{rows}}};\n")


# --- random numbers: splitmix64 and xoshiro128** in integers of any length ---

M32, M64 = 2**32 - 1, 2**64 - 1


def splitmix64(seed):
    while True:
        seed = (seed + 0x9E3779B97F4A7C15) & M64
        z = seed
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & M64
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & M64
        yield z ^ (z >> 31)


def xoshiro(seed):
    def rotl(x, k):
        return ((x << k) | (x >> (32 - k))) & M32

    words = splitmix64(seed)
    first, second = next(words), next(words)
    s = [first & M32, first >> 32, second & M32, second >> 32]
    while True:
        yield (rotl((s[1] * 5) & M32, 7) * 9) & M32
        t = (s[1] << 9) & M32
        s[2] ^= s[0]
        s[3] ^= s[1]
        s[1] ^= s[2]
        s[0] ^= s[3]
        s[2] ^= t
        s[3] = rotl(s[3], 11)


def random_numbers():
    seeds = [0, 1, 12345, 2**64 - 1]
    lines.append(
        "/* seeds of random_output */\nstatic const uint64_t random_seed[4] = {"
        + ", ".join(f"{s}u" for s in seeds)
        + "};\n"
    )
    emit(
        "uint32_t",
        "random_output",
        [list(itertools.islice(xoshiro(s), 8)) for s in seeds],
        "first numbers of xoshiro128** seeded through splitmix64",
    )


# --- selection (3)(4) ---


def boltzmann(q, temperature):
    e = exp((q - q.max()) / temperature)
    return e / e.sum()


def selection():
    episodes = np.array([1, 2, 10, 100, 2500])
    emit("int32_t", "temperature_episode", episodes, "t of (4)")
    emit("double", "temperature", [1 / mpmath.log(int(t) + mpf("0.1")) for t in episodes], "T of (4)")
    q = single(rng.normal(0, 2, (4, 9)))
    t = single([10.5, 1.0, 0.128, 0.01])
    emit("float", "selection_q", q, "Q(s, a)")
    emit("float", "selection_temperature", t, "T")
    emit("double", "selection_probability", [boltzmann(a, b) for a, b in zip(q, t, strict=True)], "pi(s, a) of (3)")


# --- the network (13)-(21) ---

UNITS, INPUTS = 7, 5
RATES = single([0.1, 0.01, 0.1])  # alpha_w, alpha_sigma, alpha_mu


def activations(w, sigma, mu, x):
    return exp(-((x - mu) ** 2).sum(1) / sigma**2)


def value(w, sigma, mu, x):
    return (w * activations(w, sigma, mu, x)).sum()


def learn_printed(w, sigma, mu, x, alpha, delta):
    phi = activations(w, sigma, mu, x)
    norm = ((x - mu) ** 2).sum(1)
    return (
        w + RATES[0] * alpha**2 * delta * phi,
        sigma + RATES[1] * alpha**2 * delta * w * norm / sigma**3 * phi,
        mu + (RATES[2] * alpha**2 * delta * w / sigma**2 * phi)[:, None] * (x - mu),
    )


def learn_exact(w, sigma, mu, x, alpha, delta):
    """(16)-(18) with the derivative of (15) by central differences; the target is y + alpha delta."""
    target = value(w, sigma, mu, x) + alpha * delta

    def error(parameters):
        a, b, c = np.split(parameters, [UNITS, 2 * UNITS])
        return 0.5 * (target - value(a, b, c.reshape(UNITS, INPUTS), x)) ** 2

    start = np.concatenate([w, sigma, mu.ravel()])
    h = mpf("1e-5")
    slope = np.array([(error(start + h * e) - error(start - h * e)) / (2 * h) for e in np.eye(len(start), dtype=int)])
    rate = np.repeat(RATES, [UNITS, UNITS, UNITS * INPUTS])
    a, b, c = np.split(start - rate * slope, [UNITS, 2 * UNITS])
    return a, b, c.reshape(UNITS, INPUTS)


def network():
    lines.append(f"enum {{ NETWORK_UNITS = {UNITS}, NETWORK_INPUTS = {INPUTS} }};\n")
    w = single(rng.normal(0, 3, UNITS))
    sigma = single(rng.uniform(0.4, 1.5, UNITS))
    mu = single(rng.uniform(0, 1, (UNITS, INPUTS)))
    x = single(rng.uniform(0, 1, (4, INPUTS)))
    alpha, delta = single([0.1, 0.5, 0.1, 1.0]), single([7.0, -2.0, -30.0, 0.25])
    emit("float", "network_weight", w, "w_j")
    emit("float", "network_width", sigma, "sigma_j")
    emit("float", "network_centre", mu, "mu_ij [unit][input]")
    emit("float", "network_x", x, "inputs")
    emit("double", "network_phi", [activations(w, sigma, mu, a) for a in x], "phi_j(x) of (14)")
    emit("double", "network_y", [value(w, sigma, mu, a) for a in x], "y of (13)")
    emit("float", "learn_alpha", alpha, "alpha of (2)")
    emit("float", "learn_delta", delta, "delta of (1)")
    for name, rule, text in (
        ("printed", learn_printed, "(19)-(21) as printed"),
        ("exact", learn_exact, "(16)-(18) with the derivative of (15) by central differences"),
    ):
        results = [rule(w, sigma, mu, *case) for case in zip(x, alpha, delta, strict=True)]
        for part, parameter in enumerate(("weight", "width", "centre")):
            emit("double", f"{name}_{parameter}", [r[part] for r in results], f"after one step from each x: {text}")


# --- the learner: Q-learning over a sequence of steps ---


def learner():
    controlled, states, steps = 2, 3, 12
    units, inputs = 6, states + controlled
    draw = (n / 2**32 for n in xoshiro(7))
    centre = [np.floor(next(draw) * 2**24) / 2**24 for _ in range(units * inputs)]
    w, sigma, mu = exact(np.full(units, 0.5)), exact(np.ones(units)), exact(np.reshape(centre, (units, inputs)))
    alpha, gamma = single(0.5), single(0.9)
    s = single(rng.uniform(0, 1, (steps + 1, states)))
    action = rng.integers(0, 3**controlled, steps)
    reward = single(rng.normal(0, 5, steps))
    terminal = (np.arange(steps) % 5 == 4).astype(int)

    def joint(state, a):
        return np.concatenate([state, [mpf(a % 3) / 2, mpf(a // 3) / 2]])

    deltas, maxima = [], []
    for k in range(steps):
        q_next = max(value(w, sigma, mu, joint(s[k + 1], a)) for a in range(3**controlled))
        x = joint(s[k], action[k])
        delta = reward[k] + (0 if terminal[k] else gamma * q_next) - value(w, sigma, mu, x)
        w, sigma, mu = learn_printed(w, sigma, mu, x, alpha, delta)
        deltas.append(delta)
        maxima.append(q_next)
    lines.append(
        f"enum {{ LEARNER_STEPS = {steps}, LEARNER_STATES = {states}, LEARNER_CONTROLLED = {controlled}, "
        f"LEARNER_UNITS = {units} }};\n"
    )
    emit("float", "learner_state", s, "state inputs before each step, and after the last")
    emit("int32_t", "learner_action", action, "joint action of each step")
    emit("float", "learner_reward", reward, "r of each step")
    emit("int32_t", "learner_terminal", terminal, "whether the step ends the episode for good")
    emit("double", "learner_q_max", maxima, "max over a of Q(s', a) before the step is learned")
    emit("double", "learner_td_error", deltas, "delta of (1), learning rate 0.5")
    emit("double", "learner_weight", w, "w_j after all steps")


# --- rotations, as matrices ---


def rotation(axis, angle):
    x, y, z = axis
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3, dtype=int) + mpmath.sin(angle) * k + (1 - mpmath.cos(angle)) * k @ k


def attitude(yaw, pitch, roll):
    return rotation((0, 0, 1), yaw) @ rotation((0, 1, 0), pitch) @ rotation((1, 0, 0), roll)


def quaternion(r, sign=1):
    """The eigenvector of Bar-Itzhack's matrix for its largest eigenvalue, as w, x, y, z, with w of the given sign."""
    k = mpmath.matrix(
        [
            [r[0, 0] - r[1, 1] - r[2, 2], r[1, 0] + r[0, 1], r[2, 0] + r[0, 2], r[2, 1] - r[1, 2]],
            [r[1, 0] + r[0, 1], r[1, 1] - r[0, 0] - r[2, 2], r[2, 1] + r[1, 2], r[0, 2] - r[2, 0]],
            [r[2, 0] + r[0, 2], r[2, 1] + r[1, 2], r[2, 2] - r[0, 0] - r[1, 1], r[1, 0] - r[0, 1]],
            [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], np.trace(r)],
        ]
    )
    x, y, z, w = mpmath.eigsy(k)[1][:, 3]
    return sign * mpmath.sign(w) * np.array([w, x, y, z])


def quaternions(matrices):
    """Every second one with negative w: it is the same attitude."""
    return [quaternion(r, (-1) ** k) for k, r in enumerate(matrices)]


def rotations():
    angles = single(rng.uniform((-3.1, -1.5, -3.1), (3.1, 1.5, 3.1), (8, 3)))
    angles[0] = single((0, 0, 0))
    angles[1] = single((0.3, 1.55, -0.2))
    matrices = [attitude(*a) for a in angles]
    v = single(rng.normal(0, 1, 3))
    emit("double", "rotation_angles", angles, "yaw, pitch, roll [rad]")
    emit("float", "rotation_quaternion", quaternions(matrices), "w, x, y, z")
    emit("double", "rotation_tilt", [mpmath.acos(r[2, 2]) for r in matrices], "angle between the z axes [rad]")
    emit("float", "rotation_vector", v, "to be turned")
    emit("double", "rotation_turned", [r @ v for r in matrices], "the vector, turned")


# --- NE stability margin (10)(11) ---


def tipping_rise(a, b, g):
    """How far g rises at most when it is turned about the line a, b: tried at many angles, then refined."""
    k = (b - a) / mpmath.sqrt((b - a) @ (b - a))

    def height(angle):
        return (a + rotation(k, angle) @ (g - a))[2]

    best, width = mpf(0), mpmath.pi
    for _ in range(20):
        best = max((best + width * n / 6 for n in range(-6, 7)), key=height)
        width /= 4
    return height(best) - g[2]


def cross2(u, v):
    return u[0] * v[1] - u[1] * v[0]


def margin(points, g):
    """An edge of the hull is a pair of points with all others on its left."""
    inside, outside = [], []
    for a, b in itertools.permutations(points, 2):
        if all(cross2((b - a)[:2], (c - a)[:2]) > 0 for c in points if c is not a and c is not b):
            rise = tipping_rise(a, b, g)
            (inside if cross2((b - a)[:2], (g - a)[:2]) >= 0 else outside).append(rise)
    return -min(outside) if outside else min(inside)


def stability():
    edges = single(rng.normal(0, 1, (16, 3, 3)))
    edges[8:12, 2, 2] -= 3  # centre of mass far below the edge
    edges[12:, 1, :2] = edges[12:, 0, :2] + mpf("0.05") * edges[12:, 1, :2]  # steep
    edges = single(edges)
    emit("float", "edge", edges, "a, b, centre of mass")
    emit("double", "edge_rise", [tipping_rise(*e) for e in edges], "S_i of (10), by turning about a->b")
    points = rng.normal(0, 1, (12, 6, 3)) * (1, 1, 0.1)
    points = single(points)
    mass = single(rng.normal(0, 0.6, (12, 3)) + (0, 0, 0.8))
    emit("float", "hull_points", points, "six support points")
    emit("float", "hull_mass", mass, "centre of mass")
    emit("double", "hull_margin", [margin(list(p), g) for p, g in zip(points, mass, strict=True)], "S_NE of (11)")


# --- kinematics of config/crawler.urdf, by 4x4 matrices ---


def numbers(element, key):
    return exact(element.get(key).split())


def transform(r, p):
    t = exact(np.eye(4))
    t[:3, :3], t[:3, 3] = r, p
    return t


class Crawler:
    def __init__(self, path):
        self.root = xml.etree.ElementTree.parse(path).getroot()
        self.joints = self.root.findall("joint")
        self.arms = [a.get("joint") for a in self.root.findall("limphome/arm")]

    def frames(self, body, angles):
        """World transforms of all links; the URDF lists parents first."""
        frames = {"base": body}
        for joint in self.joints:
            turn = np.eye(3, dtype=int)
            if joint.get("name") in self.arms:
                turn = rotation(numbers(joint.find("axis"), "xyz"), angles[self.arms.index(joint.get("name"))])
            frames[joint.find("child").get("link")] = (
                frames[joint.find("parent").get("link")]
                @ transform(np.eye(3, dtype=int), numbers(joint.find("origin"), "xyz"))
                @ transform(turn, 0)
            )
        return frames

    def posture(self, body, angles):
        frames = self.frames(body, angles)
        total, moment = 0, exact(np.zeros(3))
        for link in self.root.findall("link"):
            inertial = link.find("inertial")
            mass = mpf(inertial.find("mass").get("value"))
            origin = inertial.find("origin")
            centre = exact(np.zeros(3)) if origin is None else numbers(origin, "xyz")
            moment += mass * (frames[link.get("name")] @ [*centre, 1])[:3]
            total += mass
        marks = self.root.find("limphome")
        supports = [
            (frames[s.get("link")] @ [*numbers(s, "xyz"), 1])[:3]
            for s in [*marks.findall("support"), marks.find("tip")]
        ]
        supports[-1][2] -= mpf(marks.find("tip").get("radius"))
        return moment / total, np.array(supports)


def kinematics():
    crawler = Crawler(HERE / "../../config/crawler.urdf")
    angles = single(rng.uniform((-2.6, -0.6, -2.4), (2.6, 1.2, 0), (8, 3)))
    turns = single(rng.uniform((-3, -0.5, -0.6), (3, 0.5, 0.6), (8, 3)))
    angles[0], turns[0] = single((0, 0.6, -1.5)), single((0, 0, 0))  # initial pose
    angles[1], turns[1] = single((1.2, -0.4, -0.9)), single((0.4, 0, -0.35))
    attitudes = [attitude(*t) for t in turns]
    postures = [crawler.posture(transform(r, 0), a) for r, a in zip(attitudes, angles, strict=True)]
    emit("float", "posture_attitude", quaternions(attitudes), "w, x, y, z, body to world")
    emit("float", "posture_angles", angles, "swing, boom, arm [rad]")
    emit("double", "posture_mass", [p[0] for p in postures], "centre of mass, body origin, world axes [m]")
    emit("double", "posture_supports", [p[1] for p in postures], "four of the crawlers, then the tip's lowest [m]")
    centre, supports = postures[0]
    emit(
        "double", "initial_margin", [margin(list(supports[:4]), centre)], "S_NE of the initial pose, tip in the air [m]"
    )


# --- rewards (5)-(9)(12) ---


def rewards():
    before = single(np.column_stack([rng.normal(0, 5, (8, 2)), rng.uniform(-3.1, 3.1, 8)]))
    after = single(before + rng.normal(0, 0.2, (8, 3)))
    before[0, 2], after[0, 2] = single(3.1), single(-3.1)  # heading passes through pi
    direction = single(rng.uniform(-3.1, 3.1, 8))
    motion = np.empty((8, 2), dtype=object)
    for k in range(8):
        p = after[k, :2] - before[k, :2]
        e = np.array([mpmath.cos(before[k, 2]), mpmath.sin(before[k, 2])])
        theta = mpmath.atan2(cross2(e, p), e @ p)
        d1, d2 = mpmath.hypot(*p) * mpmath.cos(theta), mpmath.hypot(*p) * mpmath.sin(theta)
        for reading, origin in enumerate((before[k, 2], direction[k])):
            phi = mpmath.arg(mpmath.expj(after[k, 2] - origin))
            motion[k, reading] = 8 * d1 - 2 * abs(d2) - 10 * abs(phi)
    emit("float", "motion_before", before, "x, y, heading")
    emit("float", "motion_after", after, "x, y, heading")
    emit("float", "motion_direction", direction, "direction of the episode [rad]")
    emit("double", "motion_reward", motion, "r(1) of (8) with phi: change of heading, heading error")


random_numbers()
selection()
network()
learner()
rotations()
stability()
kinematics()
rewards()
head = (
    "/* Written by reference.py; do not edit. */\n/* clang-format off */\n"
    "#ifndef LIMPHOME_TEST_REFERENCE_H\n#define LIMPHOME_TEST_REFERENCE_H\n\n#include <stdint.h>\n\n"
)
print(head + "\n".join(lines) + "\n#endif")
