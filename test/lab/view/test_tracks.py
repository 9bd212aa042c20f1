"""A recorded episode at any moment of it, against motions that are known in closed form."""

import numpy as np
import pytest

import logs
from limphome import episode_t
from limphome_lab import paths, quaternion
from limphome_lab.channels import DECISION, EPISODE, STATE
from limphome_lab.ending import InputError
from limphome_lab.robot import read
from limphome_lab.view.recorded import Recording, centre_of_mass

PERIOD = 0.5  # [s]
S = 1_000_000
VELOCITY = np.array([0.2, -0.1, 0.05])  # [m/s]
RATES = np.array([0.3, 0.1, 0.4, -0.2, 0.5])  # of the actuators [m/s, rad/s]
AXIS, TURN_RATE = np.array([2.0, 3.0, 6.0]) / 7, 0.8  # [rad/s]
BEGIN = quaternion.about((0, 0, 1), 1.0)


def orientation(time):
    return quaternion.product(quaternion.about(AXIS, TURN_RATE * time), BEGIN)


def state(session, seq, time, begin=0.0):
    padded = [*(RATES * time), 0, 0, 0]
    return logs.message(
        STATE,
        session=session,
        seq=seq,
        utime=round((begin + seq * PERIOD) * S),
        num_actuators=5,
        position=list(VELOCITY * time),
        # each other one with the opposite sign, which is the same turn
        orientation=list(orientation(time) * (-1) ** seq),
        actuator_position=padded,
        actuator_health=[1 if seq >= 4 else 0, 0, 0, 0, 0, 0, 0, 0],
    )


def decision(session, seq, episode, step):
    return logs.message(
        DECISION, session=session, seq=seq, episode=episode, step=step, q=float(seq), stability_margin=0.1 * seq
    )


def ending(session, episode, end, steps, outcome=episode_t.GOAL):
    return logs.message(
        EPISODE,
        session=session,
        episode=episode,
        utime=round(end * S),
        duration=steps * PERIOD,
        steps=steps,
        outcome=outcome,
    )


def recorded():
    """Episode 1 of 4 steps, episode 2 of 3 that begins where it ended, a reset, episode 3 of 2, and 4 under way."""
    for seq in range(8):
        yield state(7, seq, seq * PERIOD)
        if seq == 2:
            yield state(7, seq, 99.0)  # the same comes again
        yield decision(7, seq, 1 if seq < 4 else 2, seq % 4)
        if seq == 4:
            yield ending(7, 1, 2.0, 4)
    yield ending(7, 2, 3.5, 3, episode_t.TUMBLE)
    for seq in range(5):
        yield state(8, seq, seq * PERIOD)
        yield decision(8, seq, 3 if seq < 2 else 4, seq % 2)
        if seq == 2:
            yield ending(8, 3, 1.0, 2)


@pytest.fixture(scope="module")
def robot():
    return read(paths.CONFIG / "crawler.urdf")


@pytest.fixture
def recording(tmp_path, robot):
    logs.write(tmp_path / "log", recorded())
    return Recording(tmp_path / "log", robot)


def test_episodes_that_are_recorded(recording):
    assert recording.numbers == [1, 2, 3, 4]
    tracks = [recording.episode(number) for number in recording.numbers]
    assert [track.outcome for track in tracks] == ["goal", "tumble", "goal", "under way"]
    assert [track.duration for track in tracks] == [2.0, 1.5, 1.0, 1.0]
    assert [len(track.states) for track in tracks] == [5, 4, 3, 3]
    assert recording.episode().number == 3  # the last that ended
    with pytest.raises(InputError, match="no states of episode 9; it has those of 1 to 4"):
        recording.episode(9)


@pytest.mark.parametrize("time", [0.0, 0.2, 0.5, 0.75, 1.3, 2.0])
def test_motion_between_states_goes_on_at_a_constant_rate(recording, time):
    frame = recording.episode(1).at(time)
    assert frame.time == pytest.approx(time)
    assert frame.position == pytest.approx(VELOCITY * time)
    assert frame.actuator_position == pytest.approx(RATES * time)
    assert abs(np.dot(frame.orientation, orientation(time))) == pytest.approx(1)
    assert np.linalg.norm(frame.orientation) == pytest.approx(1)


def test_ends_are_held(recording):
    track = recording.episode(1)
    assert track.at(-1.0).position == pytest.approx(np.zeros(3))
    assert track.at(99.0).position == pytest.approx(VELOCITY * 2)


def test_later_episodes_begin_where_the_one_before_ended_or_anew_after_a_reset(recording):
    assert recording.episode(2).at(0.3).position == pytest.approx(VELOCITY * 2.3)
    assert recording.episode(3).at(0.3).position == pytest.approx(VELOCITY * 0.3)


def test_health_and_decision_are_those_of_the_state_before(recording):
    track = recording.episode(2)
    assert list(recording.episode(1).at(1.99).health) == [0] * 5 and list(track.at(0.0).health) == [1, 0, 0, 0, 0]
    assert [track.decision(time).q for time in (0.0, 0.49, 0.5, 1.2)] == [4, 4, 5, 6]
    assert track.at(0.6).margin == pytest.approx(0.5)
    # the state in which episode 1 ended is decided upon by the first decision of episode 2, which is not shown for it
    assert recording.episode(1).decision(2.0).episode == 1


def test_trail_leads_through_the_states_to_the_moment(recording):
    trail = np.array(recording.episode(1).trail(1.2))
    assert trail == pytest.approx(np.outer([0, 0.5, 1.0, 1.2], VELOCITY))


def test_centre_of_mass_is_that_of_the_robot_file(robot, recording):
    frame = recording.episode(1).at(0.7)
    home = robot.told["home"]
    frame.actuator_position, frame.position = np.array(home["angles"]), np.array([1.0, 2.0, 0.0])
    frame.orientation = quaternion.about((0, 0, 1), np.pi / 2)
    x, y, z = home["centre_of_mass"]
    assert centre_of_mass(robot, frame) == pytest.approx([1 - y, 2 + x, z], abs=1e-6)


def test_torn_and_thinned_recordings_have_what_is_left(tmp_path, robot):
    messages = list(recorded())
    kept = [each for at, each in enumerate(messages) if at < 6 or each[0] == EPISODE or at > 20]
    logs.write(tmp_path / "log", kept)
    content = (tmp_path / "log").read_bytes()
    (tmp_path / "log").write_bytes(content[:-5])
    recording = Recording(tmp_path / "log", robot)
    assert 2 not in recording.numbers and {1, 4} <= set(recording.numbers)
    assert recording.episode(1).duration == 1.0


def test_recording_without_an_episode_is_refused(tmp_path, robot):
    logs.write(tmp_path / "log", [state(7, 0, 0.0)])
    with pytest.raises(InputError, match="nothing to show"):
        Recording(tmp_path / "log", robot)
