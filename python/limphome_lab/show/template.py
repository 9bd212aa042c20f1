"""Writes a robot file from a handful of dimensions, for those who have none yet."""

from dataclasses import dataclass

from limphome_lab.ending import InputError

GRAVITY = 9.81  # [m/s^2]
BELT_SPEED = 0.9  # [m/s]
MOST_SECTIONS = 6  # of the arm's sections and the swing below it: the other actuators are the crawlers

# The proportions of config/crawler.urdf, which has the paper's dimensions.
LENGTH = 1.6  # [m]
MASS = 500.0  # of the undercarriage, of that length [kg]


@dataclass
class Sizes:
    length: float
    width: float
    track_width: float
    track_radius: float
    mass: float
    upper_mass: float
    arm: list[float]  # lengths of its sections
    arm_mass: list[float]

    @property
    def total(self):
        return self.mass + self.upper_mass + sum(self.arm_mass)

    @property
    def shoulder(self):
        """Of the first section's joint: (ahead of the middle, above the ground) [m]."""
        return 0.25 * self.length, self.swing_height + 0.19 * self.length

    @property
    def swing_height(self):
        return 2 * self.track_radius + 0.09 * self.length


def add_arguments(parser):
    group = parser.add_argument_group(
        "a file to begin with", "What is left out follows from the length by the proportions of config/crawler.urdf."
    )
    group.add_argument("--template", action="store_true", help="write a commented robot file to stdout")
    for name, metavar, meaning in (
        ("length", "M", "of the crawlers over all, default 1.6"),
        ("width", "M", "of the robot over both crawlers"),
        ("track-width", "M", "of one crawler"),
        ("track-radius", "M", "of its round ends"),
        ("mass", "KG", "of the undercarriage with its crawlers"),
        ("upper-mass", "KG", "of the upper body that swings on it"),
    ):
        group.add_argument(f"--{name}", type=float, metavar=metavar, help=meaning)
    group.add_argument("--arm", type=_numbers, metavar="M,M", help="lengths of the arm's sections, first the boom")
    group.add_argument("--arm-mass", type=_numbers, metavar="KG,KG", help="their masses")


def given(args):
    """Whether any of the dimensions is."""
    return any(getattr(args, name) is not None for name in Sizes.__dataclass_fields__)


def text(args):
    """The file, as URDF."""
    sizes = _sizes(args)
    _check(sizes)
    return _file(sizes)


def _numbers(words):
    return [float(word) for word in words.split(",")]


def _sizes(args):
    def chosen(name, otherwise):
        value = getattr(args, name)
        return otherwise if value is None else value

    length = chosen("length", LENGTH)
    mass = chosen("mass", MASS * (length / LENGTH) ** 3)
    arm = chosen("arm", [0.69 * length, 0.5 * length])
    return Sizes(
        length=length,
        width=chosen("width", 0.78 * length),
        track_width=chosen("track_width", 0.19 * length),
        track_radius=chosen("track_radius", 0.11 * length),
        mass=mass,
        upper_mass=chosen("upper_mass", 0.7 * mass),
        arm=arm,
        arm_mass=chosen("arm_mass", [0.1 * mass * section / length for section in arm]),
    )


def _check(sizes):
    for name, value in vars(sizes).items():
        for number in value if isinstance(value, list) else [value]:
            if not 0 < number < 1e6:
                raise InputError(f"--{name.replace('_', '-')}: {number:g} must be above 0")
    if not 0 < len(sizes.arm) < MOST_SECTIONS:
        raise InputError(f"--arm: {len(sizes.arm)} sections; must be 1 to {MOST_SECTIONS - 1}")
    if len(sizes.arm_mass) != len(sizes.arm):
        raise InputError(f"--arm-mass: {len(sizes.arm_mass)} masses for {len(sizes.arm)} sections of the arm")
    if 2 * sizes.track_radius > sizes.length:
        raise InputError(
            f"--track-radius: twice {sizes.track_radius:g} m is longer than the crawler, {sizes.length:g} m"
        )
    if 2 * sizes.track_width >= sizes.width:
        raise InputError(f"--track-width: two of {sizes.track_width:g} m leave nothing of a width of {sizes.width:g} m")
    height = sizes.shoulder[1]
    if sum(sizes.arm) < 1.1 * height:
        raise InputError(f"--arm: {sum(sizes.arm):g} m cannot reach the ground from a shoulder {height:.3g} m above it")


def _inertial(mass, size, centre=(0, 0, 0)):
    """Of a box of even density."""
    x, y, z = (edge * edge * mass / 12 for edge in size)
    return (
        f'    <inertial>\n      <origin xyz="{_words(centre)}"/>\n      <mass value="{mass:.4g}"/>\n'
        f'      <inertia ixx="{y + z:.4g}" iyy="{x + z:.4g}" izz="{x + y:.4g}" ixy="0" ixz="0" iyz="0"/>\n'
        "    </inertial>\n"
    )


def _box(size, centre):
    """Seen and touched alike."""
    shape = f'<origin xyz="{_words(centre)}"/><geometry><box size="{_words(size)}"/></geometry>'
    return f"    <visual>{shape}</visual>\n    <collision>{shape}</collision>\n"


def _link(name, *parts):
    return f'  <link name="{name}">\n{"".join(parts)}  </link>\n'


def _joint(name, kind, parent, child, origin, axis, limit):
    return (
        f'  <joint name="{name}" type="{kind}">\n    <parent link="{parent}"/><child link="{child}"/>\n'
        f'    <origin xyz="{_words(origin)}"/><axis xyz="{_words(axis)}"/>\n    <limit {limit}/>\n  </joint>\n'
    )


def _words(numbers):
    return " ".join(f"{number:.4g}" for number in numbers)


def _undercarriage(s):
    inner = s.width - 2 * s.track_width
    bottom, top = 0.8 * s.track_radius, 2 * s.track_radius + 0.05 * s.length
    sprocket = 0.002 * s.mass
    yield "  <!-- Undercarriage. The crawlers are no links: <limphome> below tells their shape. -->\n"
    yield _link(
        "base",
        _inertial(s.mass - 2 * sprocket, (s.length, s.width, top), (0, 0, top / 2)),
        _box((0.75 * s.length, 0.98 * inner, top - bottom), (0, 0, (top + bottom) / 2)),
    )
    yield "\n  <!-- Sprockets: all that turns with a crawler, seen at its sprocket; the joint turns it. -->\n"
    half = s.length / 2 - s.track_radius
    across = (s.width - s.track_width) / 2
    effort = 0.6 * s.total * GRAVITY * s.track_radius
    limit = f'effort="{effort:.3g}" velocity="{BELT_SPEED / s.track_radius:.3g}"'
    for side, sign in (("left", 1), ("right", -1)):
        size = (2 * s.track_radius, s.track_width, 2 * s.track_radius)
        yield _link(f"{side}_sprocket", _inertial(sprocket, size))
        origin = (-half, sign * across, s.track_radius)
        yield _joint(f"{side}_crawler", "continuous", "base", f"{side}_sprocket", origin, (0, 1, 0), limit)


def _upper_body(s):
    size = (0.62 * s.length, 0.64 * s.width, 0.5 * s.length)
    behind = -0.06 * s.length
    yield "\n  <!-- Upper body, which swings on the undercarriage. -->\n"
    yield _link(
        "upper_body",
        _inertial(s.upper_mass, size, (behind, 0, 0.4 * size[2])),
        _box(size, (behind, 0, size[2] / 2)),
    )
    effort = 0.2 * s.total * GRAVITY * sum(s.arm)
    limit = f'lower="-2.6" upper="2.6" effort="{effort:.3g}" velocity="1"'
    yield _joint("swing", "revolute", "base", "upper_body", (0, 0, s.swing_height), (0, 0, 1), limit)


def _ranges(s):
    """Of each section's joint: (lower, upper, home) [rad]; positive angles raise, 0 continues the section before."""
    ranges = [(-0.6, 1.2, 0.6), (-2.4, 0.0, -1.5)][: len(s.arm)]
    ranges += [(-1.2, 1.2, 0.0)] * (len(s.arm) - 2)
    if len(s.arm) == 1:
        ranges = [(-1.3, 1.2, 0.3)]
    return ranges


def _section_name(index):
    return ("boom", "arm")[index] if index < 2 else f"arm_{index}"


def _arm(s):
    yield "\n  <!-- Arm: each section begins at its joint and lies along x. Positive angles raise. -->\n"
    x, z = s.shoulder
    parent, origin = "upper_body", (x, 0, z - s.swing_height)
    for i, (length, mass, (lower, upper, _)) in enumerate(zip(s.arm, s.arm_mass, _ranges(s), strict=True)):
        name = _section_name(i)
        size = (length, 0.12 * length, 0.12 * length)
        middle = (length / 2, 0, 0)
        yield _link(name, _inertial(mass, size, middle), _box(size, middle))
        effort = 0.5 * s.total * GRAVITY * sum(s.arm[i:])
        limit = f'lower="{lower:g}" upper="{upper:g}" effort="{effort:.3g}" velocity="1"'
        yield _joint(name, "revolute", parent, name, origin, (0, -1, 0), limit)
        parent, origin = name, (length, 0, 0)


def _extension(s):
    across = (s.width - s.track_width) / 2
    homes = [("swing", 0.0)] + [(_section_name(i), home) for i, (_, _, home) in enumerate(_ranges(s))]
    last = len(s.arm) - 1
    yield """
  <!-- What URDF has no words for; docs/robot.md tells all of it.
       crawler: left, then right; its middle is at xyz in the frame of the parent of `joint`; length and width over all.
       arm:     the joints that drag, from root to tip; `home` is the angle of the initial pose.
       tip:     the ball at the end of the arm that may touch the ground. -->
  <limphome>
"""
    for side, sign in (("left", 1), ("right", -1)):
        middle = _words((0, sign * across, s.track_radius))
        yield (
            f'    <crawler joint="{side}_crawler" xyz="{middle}" length="{s.length:.4g}" width="{s.track_width:.4g}" '
            f'radius="{s.track_radius:.4g}"/>\n'
        )
    for joint, home in homes:
        yield f'    <arm joint="{joint}" home="{home:g}"/>\n'
    radius = 0.1 * s.arm[last]
    yield f'    <tip link="{_section_name(last)}" xyz="{s.arm[last]:.4g} 0 0" radius="{radius:.3g}"/>\n'
    yield "  </limphome>\n"


def _file(s):
    parts = [*_undercarriage(s), *_upper_body(s), *_arm(s), *_extension(s)]
    return f"""<?xml version="1.0"?>
<!-- A crawler robot of {s.total:.4g} kg to begin with, by limphome's robot command: change what you know better.
     Lengths in m, masses in kg, angles in rad, torques in N m. Frame: x forward, y left, z up, origin on the ground,
     midway between the crawlers. Inertias are those of boxes of even density. -->
<robot name="mine">

{"".join(parts)}</robot>
"""
