"""A recording along one line of time."""

import logs
from limphome_lab.channels import COMMAND, DECISION, EPISODE, STATE
from limphome_lab.timeline import timeline

S = 1_000_000


def state(session, seconds):
    return logs.message(STATE, session=session, utime=round(seconds * S))


def times(path, *messages):
    """[s] of what was recorded."""
    logs.write(path, messages)
    return [time / S for time, _, _ in timeline(path)]


def test_sessions_follow_one_another_although_each_begins_at_0(tmp_path):
    told = times(tmp_path / "log", state(7, 0), state(7, 0.5), state(8, 0), state(8, 0.5), state(7, 0), state(7, 2))
    assert told == [0, 0.5, 0.5, 1, 1, 3]


def test_the_first_session_keeps_the_plants_time(tmp_path):
    assert times(tmp_path / "log", state(7, 1234.5), state(7, 1235), state(8, 1300)) == [1234.5, 1235, 1235]


def test_a_state_that_comes_again_turns_nothing_back(tmp_path):
    assert times(tmp_path / "log", state(7, 0), state(7, 0.5), state(7, 0), state(7, 1)) == [0, 0.5, 0.5, 1]


def test_what_has_another_clock_has_the_time_of_the_state_before(tmp_path):
    told = [logs.message(channel, utime=99 * S) for channel in (COMMAND, DECISION)]
    assert times(tmp_path / "log", told[0], state(7, 2), *told) == [0, 2, 2, 2]


def test_ends_of_episodes_go_on_where_states_were_thinned_out(tmp_path):
    ends = [logs.message(EPISODE, session=7, utime=end * S, duration=10.0) for end in (10, 20)]
    other = logs.message(EPISODE, session=8, utime=5 * S, duration=5.0)
    assert times(tmp_path / "log", state(7, 0), *ends, other, state(8, 6)) == [0, 10, 20, 25, 26]


def test_what_lies_before_a_tear_is_told_and_the_tear_too(tmp_path, capsys):
    path = tmp_path / "log"
    assert times(path, state(7, 0), state(7, 0.5)) == [0, 0.5]
    path.write_bytes(path.read_bytes()[:-1])
    assert len(list(timeline(path))) == 1
    assert "no whole event at byte" in capsys.readouterr().err


def test_what_is_no_message_of_ours_is_left_out(tmp_path):
    path = tmp_path / "log"
    logs.write(path, [("OTHER", state(7, 0)[1]), (DECISION, state(7, 0)[1]), state(7, 0)])
    assert [channel for _, channel, _ in timeline(path)] == [STATE]
