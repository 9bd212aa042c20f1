"""The validation itself, without what needs other engines: its references, and that it tells right from wrong."""

import json

import numpy as np
import pytest

from limphome_lab.measure import validate
from limphome_lab.measure.instrument import CRAWLER, LEFT_LOCKED, RIGHT, Instrument
from limphome_lab.measure.validation import cases, crossing, statics
from limphome_lab.measure.validation.cases import driving


def test_three_points_bear_by_the_lever_rule():
    points = np.array([[0, 0, 0], [2.0, 0, 0], [0, 4.0, 0]])
    assert statics.loads(points, np.array([0.5, 1, 9]), 100) == pytest.approx([50, 25, 25])


def test_masses_are_those_of_the_urdf():
    machine = statics.Machine(CRAWLER)
    assert machine.mass == pytest.approx(498 + 2 + 350 + 60 + 35)


def test_least_power_is_the_least():
    footing = statics.on_crawlers(statics.Machine(CRAWLER), 0.7)
    motion, pull = statics.least_power(footing, (0, 0.3))
    belt = np.where(footing.belt == RIGHT, 0.3, 0)

    def power(motion):
        vx, vy, turning = motion
        slip = np.hypot(vx - turning * footing.points[:, 1] - belt, vy + turning * footing.points[:, 0])
        return footing.friction @ slip

    for step in 1e-4 * np.vstack([np.eye(3), -np.eye(3), np.random.default_rng(1).normal(size=(50, 3))]):
        assert power(motion + step) > power(motion)
    assert pull[RIGHT] * 0.3 == pytest.approx(power(motion), rel=1e-6)  # what the drive gives, friction takes
    assert pull.sum() == pytest.approx(0, abs=1e-3)


def test_a_push_drifts_the_robot_only_where_it_slips():
    footing = statics.on_crawlers(statics.Machine(CRAWLER), 0.7)
    still, _ = statics.least_power(footing, (0, 0), push=(0, 0.9 * footing.friction.sum(), 0))
    assert np.abs(still).max() < 1e-3
    lefts = [statics.least_power(footing, (-0.1, 0.1), push=(0, push, 0))[0][1] for push in (-500, 0, 500)]
    assert lefts[0] < lefts[1] < lefts[2]


def test_a_slope_loads_the_lower_points():
    steep = 0.3
    gravity = (-statics.GRAVITY * np.sin(steep), 0, -statics.GRAVITY * np.cos(steep))  # uphill ahead
    machine = statics.Machine(CRAWLER)
    level, tilted = (statics.on_crawlers(machine, 1.0, gravity=g) for g in ((0, 0, -statics.GRAVITY), gravity))
    assert tilted.friction.sum() == pytest.approx(machine.weight * np.cos(steep))
    centre = machine.centre_of_mass(machine.frames(machine.home))
    moved = tilted.points[:, 0] @ tilted.friction / tilted.friction.sum()
    assert moved == pytest.approx(centre[0] - centre[2] * np.tan(steep))
    assert level.points[:, 0] @ level.friction / level.friction.sum() == pytest.approx(centre[0])


def test_a_wheel_at_a_step_needs_the_friction_of_its_angle():
    # weight wholly on the front circle: it goes on if friction bears the angle of the edge, as a wheel that is driven
    profile = crossing.Profile(radius=0.2, run=10.0, centre=np.array([10.0, 0.0]))
    height = 0.1
    steepness = np.arccos((0.2 - height + crossing.EDGE_RADIUS) / (0.2 + crossing.EDGE_RADIUS))
    assert crossing.gets_onto(profile, height, 1.02 * np.tan(steepness))
    assert not crossing.gets_onto(profile, height, 0.95 * np.tan(steepness))


def test_a_low_robot_crosses_a_gap_as_wide_as_from_its_rear_to_its_weight():
    profile = crossing.Profile(radius=0.05, run=2.0, centre=np.array([1.2, 0.0]))
    assert crossing.widest_gap(profile) == pytest.approx(1.2, abs=0.06)


def test_simulator_agrees_with_theory(tmp_path, monkeypatch, capsys):
    out = tmp_path / "validation.json"
    monkeypatch.setattr("sys.argv", ["validate", "--quick", "--json", str(out)])
    assert validate.main() == 0, capsys.readouterr().out
    rows = json.loads(out.read_text())["quantities"]
    assert len({row["case"] for row in rows}) >= 50


def test_wrong_physics_fails(monkeypatch):
    def too_much_friction():
        for quantity in driving._turn("", LEFT_LOCKED, (0, 0.3), statics.Machine(CRAWLER), 0.5):
            quantity.reference *= 0.7 / 0.5
            yield quantity

    monkeypatch.setattr(cases, "ALL", (too_much_friction,))
    monkeypatch.setattr("sys.argv", ["validate", "--quick"])
    assert validate.main() == 1


def test_bad_lines_are_refused(capfd):
    plant = Instrument()
    plant.process.stdin.write("fly 1\n")
    with pytest.raises(RuntimeError, match="exit code 2"):
        plant.report()
