"""scripts/clean removes what can be made again, and runs only where they are named."""

import os
import pty
import shutil
import subprocess

import pytest

from limphome_lab.paths import ROOT

FOLDERS = ("build", ".venv", "runs", "studies", ".pytest_cache", "python/limphome_lab/__pycache__", "docs")


@pytest.fixture
def tree(tmp_path):
    for name in FOLDERS:
        (tmp_path / name).mkdir(parents=True)
        (tmp_path / name / "file").write_text("x" * 100_000)
    (tmp_path / "scripts").mkdir()
    shutil.copy(ROOT / "scripts" / "clean", tmp_path / "scripts")
    return tmp_path


def clean(tree, *words, stdin=subprocess.DEVNULL):
    command = [tree / "scripts" / "clean", *words]
    return subprocess.run(command, stdin=stdin, capture_output=True, text=True, timeout=60)


def left(tree):
    return {name for name in FOLDERS if (tree / name).exists()}


def test_a_dry_run_tells_what_would_be_freed(tree):
    result = clean(tree, "--dry-run")
    assert result.returncode == 0 and left(tree) == set(FOLDERS)
    assert "/build\n" in result.stdout and "total" in result.stdout and "/runs" not in result.stdout


def test_runs_stay_unless_they_are_named(tree):
    assert clean(tree, "--yes").returncode == 0
    assert left(tree) == {"runs", "studies", "docs"}
    assert clean(tree, "runs", "--yes").returncode == 0
    assert left(tree) == {"studies", "docs"}


def test_what_is_named_alone_is_removed(tree):
    clean(tree, "caches", "--yes")
    assert left(tree) == set(FOLDERS) - {".pytest_cache", "python/limphome_lab/__pycache__"}


def test_without_a_terminal_it_does_not_go_on_by_itself(tree):
    result = clean(tree, "build")
    assert result.returncode == 2 and "--yes" in result.stderr and left(tree) == set(FOLDERS)


@pytest.mark.parametrize(("answer", "stays"), [("n\n", True), ("\n", True), ("y\n", False)])
def test_it_asks(tree, answer, stays):
    ours, theirs = pty.openpty()
    os.write(ours, answer.encode())
    clean(tree, "build", stdin=theirs)
    assert (tree / "build").exists() == stays
    os.close(ours)
    os.close(theirs)


def test_a_link_is_removed_and_not_what_it_leads_to(tree, tmp_path_factory):
    other = tmp_path_factory.mktemp("other")
    (other / "file").write_text("mine")
    shutil.rmtree(tree / ".venv")
    (tree / ".venv").symlink_to(other)
    clean(tree, "venv", "--yes")
    assert not (tree / ".venv").is_symlink() and (other / "file").exists()


@pytest.mark.parametrize("word", ["docs", "/", "--force"])
def test_any_other_word_is_refused(tree, word):
    result = clean(tree, word, "--yes")
    assert result.returncode == 2 and word in result.stderr and left(tree) == set(FOLDERS)


def test_nothing_there_is_told(tree):
    clean(tree, "--yes")
    assert "nothing to remove" in clean(tree, "--yes").stdout
