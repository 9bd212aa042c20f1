"""Figures on demand and experiments side by side, from what runs have left."""

import csv
import io
import json

import pytest

from conftest import run_script
from limphome_lab.runfolder import RunFolder


@pytest.fixture(scope="module")
def planned(tmp_path_factory):
    """Run folder of a planner, 6 episodes."""
    out = tmp_path_factory.mktemp("planned") / "run"
    run_script("train", "--episodes", 6, "--no-figures", "--quiet", "--out", out)
    return RunFolder(out)


ON_DEMAND = ("fig_rewards", "fig_margin", "fig_actions", "fig_values")


@pytest.mark.parametrize(("kind", "inputs"), [("smoke_run", "roll,arm"), ("planned", "swing,boom")])
def test_a_run_has_more_figures_on_demand(request, tmp_path, kind, inputs):
    run = request.getfixturevalue(kind)
    run_script("plot", run.path, "--value-map", inputs, "--episode", 5, "--paper", "--out", tmp_path)
    for name in ("fig7_trajectories", "fig9_motion", *ON_DEMAND):
        assert (tmp_path / f"{name}.png").read_bytes().startswith(b"\x89PNG\r\n")
        assert (tmp_path / "paper" / f"{name}.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        (("--value-map", "roll,pitch"), "must be two of swing, boom, arm"),
        (("--episode", 7), "--episode 7: is not in"),
    ],
)
def test_what_a_run_does_not_have_cannot_be_drawn(planned, tmp_path, options, reason):
    result = run_script("plot", planned.path, *options, "--out", tmp_path, check=False)
    assert result.returncode == 2 and reason in result.stderr


def test_several_runs_are_drawn_side_by_side(smoke_run, planned, tmp_path):
    result = run_script("plot", smoke_run.path, planned.path, "--out", tmp_path)
    assert {file.name for file in tmp_path.iterdir()} == {"courses.png", "rewards.png"}
    assert "learner.kind=q_learning" in result.stderr and "learner.kind=planner" in result.stderr
    result = run_script("plot", smoke_run.path, planned.path, "--episode", 1, check=False)
    assert result.returncode == 2 and "of one run" in result.stderr


def test_experiments_are_compared(smoke_run, planned):
    rows = list(csv.DictReader(io.StringIO(run_script("compare", smoke_run.path, planned.path, "--csv").stdout)))
    assert [(row["learner.kind"], row["episodes"]) for row in rows] == [("q_learning", "30"), ("planner", "6")]
    told = json.loads(run_script("compare", smoke_run.path, "--json").stdout)
    assert told["experiments"][0]["differs"] == {} and told["experiments"][0]["runs"] == 1


def test_results_are_a_page_of_the_users(smoke_run, planned, tmp_path):
    run_script("results", smoke_run.path, planned.path, "--out", tmp_path)
    text = (tmp_path / "results.md").read_text()
    assert "### smoke" in text and "### default, " not in text and "### default" in text
    for line in text.splitlines():
        if line.startswith("!["):
            assert (tmp_path / line.partition("](")[2].rstrip(")")).is_file()
