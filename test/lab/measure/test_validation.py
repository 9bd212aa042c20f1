"""The validation itself, without what needs other engines: its references, and that it tells right from wrong."""

import json

import numpy as np
import pytest

from limphome_lab.measure import validate
from limphome_lab.measure.instrument import CRAWLER, LEFT_LOCKED, RIGHT, Instrument
from limphome_lab.measure.validation import cases, statics


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


def test_simulator_agrees_with_theory(tmp_path, monkeypatch, capsys):
    out = tmp_path / "validation.json"
    monkeypatch.setattr("sys.argv", ["validate", "--quick", "--json", str(out)])
    assert validate.main() == 0, capsys.readouterr().out
    rows = json.loads(out.read_text())["quantities"]
    assert len({row["case"] for row in rows}) >= 12


def test_wrong_physics_fails(monkeypatch):
    def too_much_friction():
        for quantity in cases._turn("", LEFT_LOCKED, (0, 0.3), statics.Machine(CRAWLER), 0.5):
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
