"""Tables of what was measured, as text for the terminal and as a page of Markdown."""

from dataclasses import dataclass

PAGE = """# Validation of the simulator

Written by `scripts/validate --report docs/validation.md`; do not edit. The simulated robot is that of
`config/crawler.urdf` under `config/paper.ini` unless a row says otherwise.

## Against theory

References come from closed forms, or from the URDF alone by quasi-static analysis: the loads on the points of contact
follow from the lever rule (on equal springs under a stiff body), and the motion is the one that loses least power to
friction, the minimum of sum(mu N |slip|) over forward and sideways speed, yaw rate and the speeds of belts that turn
freely; on a slope less the power of the weight. They share no code with the simulator. Cases run on the real simulation, driven by `limphome-instrument`.

{quantities}

Notes.

- Torques: where belts stick, Coulomb's law leaves open how their points share what they do. They share it by load, the
  least sum(|force|^2 / (mu N)), in every step; nothing then pulls against anything, whatever went before. It costs no
  creep. Standing after a turn is measured once the integral part of the drives is through: for some 3 s it lets the belts
  creep, and as long as anything slips, friction is mu N in full, and so is the torque.
- Pull against slip is a step, as Coulomb has it: no slip up to mu m g, and mu m g at any slip. Soil and rubber have a curve.
  Belts and bearings have no losses, so motion resistance on level ground is none; turning has that of the skid.
- Turning radius: without skidding the circle would be far tighter (0.475 m with one belt at rest).
- Steps and gaps: at each stage two places carry and the belts pull with what friction bears; forces and moments balance.
  The simulated robot gets a little higher, the less so the slower it goes. Swinging at 20 degrees, faster than friction
  bears, it does slip: 19 mm in 3 swings.
- What energy rises is the error of integrating the freely swinging arm; it goes with the time step.

## Time step and iterations

Yaw rate with the left crawler locked, against the quasi-static rate, and place reached in 11 s of pressing down with
the arm and dragging, against a run with steps of 0.25 ms. Real-time factor: simulated time over processor time.

{convergence}

The default is 5 ms and 20 iterations: errors of a skid turn do not depend on the step, those of the place are below a
millimetre up to 10 ms, as the forces of a step are those of its middle; sweeps end by themselves once they change nothing, so a high limit costs little.
The yaw rate's remaining error is no error of the steps: the robot has inertia (the centripetal force shifts the
loads), which the quasi-static analysis leaves out, and it vanishes at low speed (last table).

## Against another engine
{mujoco}"""  # noqa: E501

MUJOCO = """
The same robot in MuJoCo: masses, joints, torque limits and points of contact from the same URDF, crawlers as boxes with
`surfacevel`, steps of 1/240 s. MuJoCo with an elliptic friction cone and with its default, a pyramid:

{comparison}

More than 10 % from ours: {far}.
The differences come from MuJoCo's friction, as the next table shows. It repeats the skid turn at lower speed, where all
engines should give the same yaw rate once it is scaled by the speed of the belt:

{by_speed}

- The pyramid is weaker along some directions than along others, and its directions are the world's: with it the yaw
  rate depends on the heading, with the elliptic cone it does not.
- At 0.3 m/s the crawlers' corners hop in MuJoCo and only some of the eight bear load at a time; at 0.003 m/s all do, and there its
  elliptic cone agrees with quasi-static analysis and with this simulator, whose points all bear load at any speed. That fits
  MuJoCo's convex contact model, which pushes a sliding point off the ground, the more the faster it slides; smaller steps
  do not mend it. What is left of the pyramid's difference at 0.003 m/s has not been explained further.
"""  # noqa: E501


@dataclass
class Table:
    head: list
    rows: list  # of texts


def _number(value):
    return "0" if abs(value) < 1e-9 else f"{value:.5g}"


def _error(value, reference):
    if abs(reference) < 1e-9:
        return f"{value:.1e}" if value else "0"
    return f"{100 * value / abs(reference):+.2f} %"


def quantities(rows):
    return Table(
        ["case", "quantity", "unit", "reference from", "reference", "measured", "error", "allowed", ""],
        [
            [
                row["case"],
                row["quantity"],
                row["unit"],
                row["source"],
                _number(row["reference"]),
                _number(row["measured"]),
                _error(row["error"], row["reference"]),
                _error(row["tolerance"], row["reference"]).lstrip("+"),
                "ok" if row["passed"] else "FAILED",
            ]
            for row in rows
        ],
    )


def convergence(rows):
    return Table(
        ["time step [ms]", "iterations", "yaw rate [rad/s]", "error", "error of place [mm]", "real-time factor"],
        [
            [
                f"{1e3 * row['time_step_s']:g}",
                str(row["iterations"]),
                f"{row['yaw_rate']:.5f}",
                f"{100 * row['yaw_rate_error']:+.2f} %",
                f"{row['place_error_mm']:.2f}",
                f"{row['real_time_factor']:.0f}",
            ]
            for row in rows
        ],
    )


def comparison(rows):
    def against(value, reference):
        return f"{_number(value)} ({100 * (value / reference - 1):+.1f} %)"

    return Table(
        ["quantity", "unit", "quasi-static", "limphome", "MuJoCo, elliptic cone", "MuJoCo, default cone"],
        [
            [
                row["quantity"],
                row["unit"],
                _number(row["reference"]),
                *(against(row[name], row["reference"]) for name in ("ours", "mujoco", "mujoco_default")),
            ]
            for row in rows
        ],
    )


def far_from_ours(rows):
    """What MuJoCo gives more than 10 % off, in words."""
    cones = {"mujoco": "elliptic", "mujoco_default": "default"}
    far = [
        f"{row['quantity']}, {cones[name]} cone ({100 * (row[name] / row['ours'] - 1):+.0f} %)"
        for row in rows
        for name in cones
        if abs(row[name] / row["ours"] - 1) > 0.1
    ]
    return "; ".join(far) or "nothing"


def by_speed(rows, speeds):
    return Table(
        ["yaw rate, scaled [rad/s] (points under load)", *(f"belt at {speed:g} m/s" for speed in speeds)],
        [
            [
                row["engine"],
                *(
                    f"{rate:.4f} ({loaded:.1f})"
                    for rate, loaded in zip(row["yaw_rates"], row["loaded_points"], strict=True)
                ),
            ]
            for row in rows
        ],
    )


def further_tables(result):
    tables = [convergence(result["convergence"])]
    if result["mujoco"]:
        tables += [
            comparison(result["mujoco"]["comparison"]),
            by_speed(result["mujoco"]["by_speed"], result["mujoco"]["speeds"]),
        ]
    return tables


def text(table):
    lines = [table.head, *table.rows]
    widths = [max(len(line[i]) for line in lines) for i in range(len(table.head))]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip() for line in lines
    )


def markdown(table):
    lines = [table.head, ["---"] * len(table.head), *table.rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def page(result):
    further = [markdown(table) for table in further_tables(result)]
    mujoco = "\nMuJoCo was not installed.\n"
    if result["mujoco"]:
        far = far_from_ours(result["mujoco"]["comparison"])
        mujoco = MUJOCO.format(comparison=further[1], by_speed=further[2], far=far)
    return PAGE.format(quantities=markdown(quantities(result["quantities"])), convergence=further[0], mujoco=mujoco)
