"""Command diagnose, on a run that does not learn and on one that does."""

import json

import pytest

from conftest import ROOT, run_script
from limphome_lab.runfolder import RunFolder


@pytest.fixture(scope="module")
def printed(tmp_path_factory):
    """(run folder of 25 episodes too short for the equations as printed, what train said)"""
    out = tmp_path_factory.mktemp("printed") / "run"
    words = ["--config", ROOT / "config" / "paper_printed.ini", "--set", "episode.step_limit=50", "--episodes", 25]
    result = run_script("train", *words, "--out", out, "--quiet", "--no-figures")
    return RunFolder(out), result.stderr


def test_training_ends_with_what_was_found(printed):
    folder, told = printed
    last = told.splitlines()[-1]
    assert last.startswith("0 of the last 20 episodes reached the goal: never reaching")
    assert last.endswith(f"; scripts/diagnose {folder.path} tells more")


def test_diagnosis_in_text_and_json(printed):
    folder, _ = printed
    text = run_script("diagnose", folder.path).stdout
    assert text.startswith("not learned\nlast 20 episodes: 0 goals, 0 tumbles, 25.0 s (at most 9)")
    assert "try rbf.gradient = exact" in text
    diagnosis = json.loads(run_script("diagnose", folder.path, "--json").stdout)
    assert diagnosis["episodes"] == 25 and diagnosis["learned_at"] is None
    found = {finding["name"]: finding["numbers"] for finding in diagnosis["findings"]}
    assert 0 < found["never reaching"]["farthest_m"] < 2 < found["never reaching"]["way_m"]


def test_run_that_learned_says_when_and_training_says_no_more(tmp_path):
    words = ["--episodes", 30, "--out", tmp_path / "run", "--quiet", "--no-figures"]
    assert run_script("train", *words).stderr.splitlines()[-1].startswith("done in ")
    diagnosis = json.loads(run_script("diagnose", tmp_path / "run", "--json").stdout)
    assert diagnosis["learned_at"] < 20 and diagnosis["findings"] == []
    assert diagnosis["last"]["goals"] == 20


def test_folder_without_an_ended_episode_is_refused(printed, tmp_path):
    folder, _ = printed
    assert "not a run folder" in run_script("diagnose", tmp_path, check=False).stderr
    for file in (folder.config, folder.robot, folder.messages):
        (tmp_path / file.name).write_bytes(file.read_bytes())
    (tmp_path / "episodes.csv").write_text(folder.episodes.read_text().partition("\n")[0] + "\n")
    result = run_script("diagnose", tmp_path, check=False)
    assert result.returncode == 2 and "no episode has ended" in result.stderr
