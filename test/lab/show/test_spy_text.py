"""Messages as text: constants by name, pages, channels by short names."""

from types import SimpleNamespace

import pytest

from limphome import decision_t, episode_t, pose_t, robot_state_t, status_t
from limphome_lab.channels import DECISION, EPISODE, POSE, STATE, STATUS
from limphome_lab.messages import TYPES
from limphome_lab.show import constants, spy, spy_text


@pytest.mark.parametrize(
    ("channel", "changes", "line"),
    [
        (STATUS, {"condition": status_t.RUNNING}, "condition RUNNING"),
        (STATUS, {"process": status_t.CONTROLLER}, "process CONTROLLER"),
        (STATUS, {"reason": status_t.BY_OPERATOR}, "reason BY_OPERATOR"),
        (STATUS, {"condition": 99}, "condition 99"),
        (EPISODE, {"outcome": episode_t.TIMEOUT}, "outcome TIMEOUT"),
        (DECISION, {"interventions": 0}, "interventions 0"),
        (DECISION, {"interventions": decision_t.TILT | decision_t.STOP}, "interventions TILT + STOP"),
        (DECISION, {"interventions": 1 << 30}, f"interventions {1 << 30}"),
        (STATE, {"num_actuators": 1}, "num_actuators 1"),
        (
            STATE,
            {"actuator_health": [1, 0, 0, 0, 0, 0, 0, 2]},
            "actuator_health FAILED OBEYS OBEYS OBEYS OBEYS OBEYS OBEYS WEAK",
        ),
        (POSE, {"pace": pose_t.PACE_FREE}, "pace PACE_FREE"),
    ],
)
def test_values_are_told_by_their_constants(channel, changes, line):
    message = TYPES[channel]()
    for name, value in changes.items():
        setattr(message, name, value)
    assert line in [" ".join(each.split()) for each in spy_text.values(channel, message.encode())]


def test_every_constant_is_one_of_its_type():
    for kind in {kind.__name__.removesuffix("_t"): kind for kind in TYPES.values()}.values():
        for names, _ in constants.of_type(kind.__name__.removesuffix("_t")).values():
            assert all(getattr(kind, name) == value for value, name in names.items())
    assert constants.of_type("robot_state")["actuator_health"][0][robot_state_t.FAILED] == "FAILED"


def test_pages_turn_round_and_hold_every_line():
    pages = spy_text.Pages()
    pages.page, lines, seen = 0, [f"line {n}" for n in range(50)], []
    for _ in range(3):
        page = pages.of(lines, 40, 24)
        assert len(page) <= 23 and all(len(line) <= 40 for line in page)
        seen += page[:-1]
        pages.page += 1
    assert seen == lines
    assert pages.of(lines, 40, 24)[0] == "line 0"


def test_what_fits_has_no_foot():
    pages = spy_text.Pages()
    pages.page = 5
    assert pages.of(["one", "two"], 80, 24) == ["one", "two"]


@pytest.mark.parametrize("name", ["STATUS", "status", STATUS])
def test_a_channel_has_a_short_name(name):
    assert spy.full_name(name, None) == STATUS


def test_a_channel_that_there_is_not_is_refused_with_those_there_are():
    def refuse(text):
        raise AssertionError(text)

    with pytest.raises(AssertionError, match=r"must be one of ARM, .*STATE, STATUS"):
        spy.full_name("STAT", SimpleNamespace(error=refuse))


def test_only_channels_that_are_wanted_are_kept():
    watched = spy_text.TextSpy("memq://", [STATUS])
    watched._receive(STATUS, status_t().encode())
    watched._receive(EPISODE, episode_t().encode())
    assert list(watched.channels) == [STATUS]
