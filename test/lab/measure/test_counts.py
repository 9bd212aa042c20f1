"""scripts/counts: what is recorded is read and compared, and a file that is none is refused."""

import pytest

from limphome_lab.ending import InputError
from limphome_lab.measure import counts


def test_names_what_takes_more_than_allowed():
    recorded = {"a": 1000, "b": 1000, "c": 1000}
    lines, more = counts.compare({"a": 1031, "b": 1029, "c": 500, "d": 7}, recorded, 0.03)
    assert more == ["a"]
    assert [line.split()[0] for line in lines] == ["name", "a", "b", "c", "d"]
    assert "+3.1 %  MORE" in lines[1] and lines[4].endswith("new")


def test_what_was_recorded_and_not_counted_again_stays(tmp_path, monkeypatch):
    monkeypatch.setattr(counts, "compiler", lambda: "GNU 12.2.0")
    file = tmp_path / "counts.txt"
    counts.record({"step": 10, "board": 20}, file)
    counts.record({"step": 11}, file)
    assert counts.read(file) == ({"step": 11, "board": 20}, "GNU 12.2.0")


@pytest.mark.parametrize("line", ["step", "step many", "step -1", "step 0"])
def test_bad_record_names_file_and_line(tmp_path, line):
    file = tmp_path / "counts.txt"
    file.write_text(f"# head\n{line}\n")
    with pytest.raises(InputError, match=r"counts\.txt:2: "):
        counts.read(file)


def test_another_compiler_is_allowed_more(monkeypatch):
    monkeypatch.setattr(counts, "compiler", lambda: "Clang 19.1.0")
    assert counts.tolerance("Clang 19.1.0") < counts.tolerance("GNU 12.2.0")


def test_reads_what_a_board_says():
    said = """
43: 38: planner
43: 38: instructions per decision, least: 8480
43: 38: instructions per decision, mean:  2759410
43: 38: instructions per decision, most:  3791120
43: 39: q_learning
43: 39: instructions per decision, least: 24840
43: 39: instructions per decision, mean:  94930
"""
    assert counts.SAID_BY_BOARD.findall(said) == [("planner", "2759410"), ("q_learning", "94930")]
