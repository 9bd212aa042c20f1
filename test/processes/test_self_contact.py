"""An arm over its own crawler: the monitor stops it before it gets there, and without one the crawler does."""

import math

import pytest

from conftest import ROOT, train
from limphome import decision_t
from limphome_lab.channels import DECISION, STATE
from limphome_lab.messages import recorded
from limphome_lab.runfolder import RunFolder

CLEARANCE = 0.02  # of the monitor [m]
TIP_RADIUS = 0.08


def robot_over_its_crawler(tmp_path, strength):
    """The paper's robot, folded and turned aside, with its tip 6 cm over the left crawler. `strength`: of the arm's
    drives, as multiples; with 10 the robot's weight does not turn joints further than told where it stands on its arm.
    """
    text = (ROOT / "config" / "crawler.urdf").read_text()
    for joint, old, new in (("swing", "0", "0.6"), ("boom", "0.6", "0.3"), ("arm", "-1.5", "-2.35")):
        home = f'<arm joint="{joint}" home="{old}"/>'
        assert home in text
        text = text.replace(home, f'<arm joint="{joint}" home="{new}"/>')
    for torque in (3000, 4000, 6000):
        assert f'effort="{torque}"' in text
        text = text.replace(f'effort="{torque}"', f'effort="{strength * torque}"')
    path = tmp_path / "robot.urdf"
    path.write_text(text)
    return path


def tip(state):
    """Its middle in the body frame."""
    swing, boom, arm = state.actuator_position[2:5]
    ahead = 0.4 + 1.1 * math.cos(boom) + 0.8 * math.cos(boom + arm)
    up = 0.8 + 1.1 * math.sin(boom) + 0.8 * math.sin(boom + arm)
    return ahead * math.cos(swing), ahead * math.sin(swing), up


def distance_from_crawlers(state):
    """Of the tip's ball."""
    x, y, z = tip(state)
    round_ends = math.hypot(max(abs(x) - 0.62, 0), z - 0.18) - 0.18
    beside = abs(abs(y) - 0.475) - 0.15
    outside = math.hypot(max(round_ends, 0), max(beside, 0))
    return (outside if outside > 0 else max(round_ends, beside)) - TIP_RADIUS


@pytest.fixture(scope="module", params=["on", "off"])
def run(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("self_contact")
    robot = robot_over_its_crawler(folder, strength=10 if request.param == "on" else 1)
    arguments = ["--robot", robot, "--episodes", 4, "--set", "episode.step_limit=60"]
    train(folder / "run", *arguments, "--set", f"safety.monitor={request.param}", "--set", "episode.reset_every=1")
    messages = list(recorded(RunFolder(folder / "run").messages, DECISION, STATE))
    distances = [distance_from_crawlers(message) for channel, message in messages if channel == STATE]
    collisions = [m for c, m in messages if c == DECISION and m.interventions & decision_t.COLLISION]
    return request.param, distances, collisions


def test_the_arm_stops_at_its_crawler(run):
    monitor, distances, collisions = run
    assert distances[0] > CLEARANCE
    if monitor == "on":
        assert collisions
        assert all(decision.stilled & 0b11100 for decision in collisions)
        assert min(distances) > CLEARANCE - 0.005
    else:
        assert not collisions
        assert min(distances) < 0.002  # it touches
        assert min(distances) > -0.003  # and goes no further
