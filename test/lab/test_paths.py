"""Paths as a person would type them."""

from limphome_lab.paths import shown


def test_below_the_working_directory_is_relative(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert shown(tmp_path / "runs" / "one") == shown("runs/one") == "runs/one"


def test_elsewhere_is_absolute(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert shown("/elsewhere/one") == "/elsewhere/one"


def test_without_a_working_directory(tmp_path, monkeypatch):
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    assert shown("/elsewhere/one") == "/elsewhere/one"
