"""What is said where a name is mistaken, or a pattern has matched more than one run."""

import argparse

import pytest

from limphome_lab import command


@pytest.mark.parametrize(
    ("name", "suffix", "guessed"),
    [
        ("smoke", ".ini", "smoke.ini"),
        ("smoke", ".toml", "studies/smoke.toml"),
        ("config/papr.ini", ".ini", "paper.ini"),
        ("both", ".ini", "both_crawlers.ini"),
        ("crawlr", ".urdf", "crawler.urdf"),
    ],
)
def test_names_are_guessed(name, suffix, guessed):
    told = command.did_you_mean(name, suffix)
    assert told.startswith("; did you mean ") and f"config/{guessed}" in told


def test_nothing_is_guessed_where_nothing_is_alike():
    assert command.did_you_mean("xyzzy", ".ini") == ""


def test_a_pattern_that_matched_two_runs_is_told_of(tmp_path, capsys):
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "config.ini").touch()
    parser = command.parser("diagnose", "", "RUN")
    parser.add_argument("run")
    with pytest.raises(SystemExit):
        parser.parse_args([str(tmp_path / "a"), str(tmp_path / "b")])
    assert f"one RUN is taken, and {tmp_path / 'b'} is over: a pattern may have matched" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        parser.parse_args([str(tmp_path / "a"), "--what"])
    assert "unrecognized arguments: --what" in capsys.readouterr().err


def test_file_to_write_is_refused_before_anything_is_measured(tmp_path):
    fresh = tmp_path / "fresh.json"
    assert command.file_to_write(str(fresh)) == fresh
    assert not fresh.exists(), "an empty file would say that something was measured"
    fresh.write_text("kept")
    assert command.file_to_write(str(fresh)).read_text() == "kept"
    for bad in (tmp_path, tmp_path / "none" / "x.json", fresh / "x.json", ""):
        with pytest.raises(argparse.ArgumentTypeError, match="directory"):
            command.file_to_write(str(bad))
