"""Reading a table while it is written."""

from dataclasses import fields

import pytest

from limphome_lab import paths
from limphome_lab.runfolder import Episode, EpisodeTail, InputError, find_robot

HEADER = ",".join(field.name for field in fields(Episode)) + "\n"


def row(number):
    return f"{number},goal,20,10.0,1.0,0,0,0,0,0.1,0,1\n"


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


def test_robot_without_a_folder_is_the_one_here_then_the_one_that_comes_along(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert find_robot("two_arm.urdf") == paths.CONFIG / "two_arm.urdf"
    assert not find_robot("none.urdf").is_absolute()
    (tmp_path / "two_arm.urdf").write_text("")
    assert find_robot("two_arm.urdf").resolve() == tmp_path / "two_arm.urdf"
    assert not find_robot("config/two_arm.urdf").is_absolute()
