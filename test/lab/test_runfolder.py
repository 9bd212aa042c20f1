"""Reading a table while it is written, summing it up, and telling how far a run has come."""

import io
from dataclasses import fields

import pytest

from limphome_lab.runfolder import Episode, EpisodeTail, InputError
from limphome_lab.show import progress
from limphome_lab.show.summary import summarise

HEADER = ",".join(field.name for field in fields(Episode)) + "\n"


def row(number, outcome="goal", duration=10.0, reward=1.0, lateral=0.1):
    return f"{number},{outcome},{round(duration * 2)},{duration},{reward},0,0,0,0,{lateral},0,1\n"


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "episodes.csv"
    path.write_text(HEADER)
    return path


def append(path, text):
    with open(path, "a") as file:
        file.write(text)


def numbers(episodes):
    return [episode.episode for episode in episodes]


def test_tail_of_a_file_that_is_not_there_yet(tmp_path):
    assert EpisodeTail(tmp_path / "none.csv").read_new() == []


def test_tail_gives_each_row_once_and_only_when_complete(table):
    tail = EpisodeTail(table)
    assert tail.read_new() == []
    append(table, row(1) + row(2)[:9])
    assert numbers(tail.read_new()) == [1]
    append(table, row(2)[9:] + row(3))
    assert numbers(tail.read_new()) == [2, 3]
    assert tail.read_new() == []


def test_tail_begins_anew_where_the_file_was_cut(table):
    tail = EpisodeTail(table)
    append(table, row(1) + row(2) + row(3))
    tail.read_new()
    table.write_text(HEADER + row(1))
    assert numbers(tail.read_new()) == [1]


def test_table_with_another_header_is_refused(table):
    table.write_text("episode,reward\n1,2\n")
    with pytest.raises(InputError, match="header"):
        EpisodeTail(table).read_new()


def test_summary(table):
    append(
        table,
        row(1, "goal", 8, 5, -0.2)
        + row(2, "timeout", 100, -3, 0.4)
        + row(3, "tumble", 9, -9, 0.1)
        + row(4, "goal", 7, 6, 0.3),
    )
    summary = summarise(EpisodeTail(table).read_new())
    assert summary["goal_share"] == 0.5
    assert (summary["tumbles"], summary["timeouts"]) == (1, 1)
    assert summary["median_duration_s"] == 8.5
    assert summary["median_lateral_error_m"] == pytest.approx(0.25)
    assert summary["median_reward"] == 1.0


def test_progress_of_a_resumed_run_counts_from_its_checkpoint(table):
    append(table, "".join(row(number, "goal" if number % 2 else "timeout") for number in range(1, 17)))
    shown = progress.Progress(total=20, done=10, stream=io.StringIO())
    shown.update(EpisodeTail(table).read_new())
    assert shown.done == 16
    assert shown.simulated_s == 6 * 10.0
    assert "episode 16/20" in shown.text(shown.began + 30)
    assert "last 6: goals  50%, reward    1.00 |    2x real time, 0:30, 0:20 left" in shown.text(shown.began + 30)


def test_clock():
    assert [progress.clock(seconds) for seconds in (0, 59.6, 3600 + 2 * 60 + 3)] == ["0:00", "1:00", "1:02:03"]
