"""What a person types while he drives by hand, and what an operator program makes of what it hears."""

import pytest

from limphome import decision_t, operate_t, robot_state_t
from limphome_lab.run.hand import ANOTHER, HELD_S, LEARNER, ME, NOBODY, Hand, HandKeys, words


class Recorder:
    """A hand that only keeps what it was told."""

    def __init__(self):
        self.told = []

    def take(self):
        self.told.append("take")

    def give(self):
        self.told.append("give")

    def drive(self, directions):
        self.told.append(directions)

    def answer(self):
        pass


def test_a_key_moves_its_actuator_while_it_is_held():
    keys = HandKeys(hand := Recorder())
    keys.press("h", 0.0)
    keys.press("2", 1.0)
    keys.press("r", 1.0)
    keys.look(1.0 + 0.9 * HELD_S)
    keys.press("2", 1.1 + 0.9 * HELD_S)  # held, as a terminal repeats it
    keys.look(1.1 + HELD_S)
    keys.press("w", 2.0)  # the other way
    keys.look(2.0)
    keys.stop()
    keys.look(2.0)
    keys.press("l", 3.0)
    keys.press("?", 3.0)
    rest = [0] * 4
    assert hand.told == [
        "take",
        [0, 1, 0, -1, *rest],
        [0, 1, 0, 0, *rest],
        [0, -1, 0, 0, *rest],
        [0] * 8,
        "give",
    ]


def test_the_keys_are_told_by_the_names_of_the_actuators():
    assert words(["left", "right", "swing"]).endswith("1/q left, 2/w right, 3/e swing")


class Mouth:
    """Keeps what is said on the bus."""

    def __init__(self):
        self.said = []

    def publish(self, _channel, data):
        self.said.append(operate_t.decode(data))


@pytest.fixture
def hand():
    """One that has heard a state of five actuators; what it says to a person is in `said`."""
    operator = Hand("memq://", (said := []).append)
    operator.said, operator.lcm, operator.state = said, Mouth(), robot_state_t()
    operator.state.num_actuators, operator.state.seq = 5, 7
    return operator


def tell(hand, in_charge, sender=0):
    decision = decision_t()
    decision.in_charge, decision.operator_sender = in_charge, sender
    hand._on_decision("", decision.encode())
    return hand.in_charge


def test_who_is_in_charge_is_told_once_and_what_is_lost_is_not_taken_again(hand):
    assert tell(hand, decision_t.LEARNER) == LEARNER
    hand.take()
    assert tell(hand, decision_t.LEARNER) == LEARNER and hand.wants  # it has not come yet
    assert tell(hand, decision_t.OPERATOR, hand.sender) == ME and hand.wants
    assert tell(hand, decision_t.NOBODY) == NOBODY and not hand.wants
    hand.take()
    assert tell(hand, decision_t.NOBODY) == NOBODY and hand.wants
    assert tell(hand, decision_t.OPERATOR, 5) == ANOTHER and not hand.wants
    assert len(hand.said) == 4
    hand._on_decision("", b"no message")
    assert hand.in_charge == ANOTHER


def test_what_is_wanted_is_said_at_once(hand):
    hand.drive([1])
    assert hand.lcm.said == []  # it was not taken
    hand.take()
    hand.drive([0, 1, -1, 0, 0, 1, 1, 1])
    hand.drive([0, 1, -1, 0, 0, 1, 1, 1])
    hand.give()
    taken, driven, given = hand.lcm.said
    assert [taken.action, driven.action, given.action] == [operate_t.TAKE, operate_t.TAKE, operate_t.GIVE]
    assert list(driven.direction) == [0, 1, -1, 0, 0, 0, 0, 0] and driven.seq == 7 and driven.sender == hand.sender
    assert not any(taken.direction) and not any(given.direction)
    assert taken.utime < driven.utime < given.utime
