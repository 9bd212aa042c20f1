"""The report of a study says what is in its folders."""

import json
from dataclasses import fields
from types import SimpleNamespace

import pytest

from limphome_lab.runfolder import Episode
from limphome_lab.study import document, plan, table

pytest.importorskip("scipy")

from limphome_lab.study import report

TABLE = """
[seeds]
tuning = [1]
test = ["11-14"]
[variants.learner]
[failures.locked]
[grounds.flat]
[evaluations.greedy]
"""
SETTINGS, DIGESTS = {"learning": {"seed": "1"}}, {"robot": "1", "simulator": "2", "controller": "3"}


def write_episodes(folder, rows):
    folder.mkdir(parents=True)
    header = ",".join(field.name for field in fields(Episode))
    lines = [f"{n},{outcome},14,{duration},0,0,0,0,0,0.02,0.01,1" for n, (outcome, duration) in enumerate(rows, 1)]
    (folder / "episodes.csv").write_text("\n".join([header, *lines]) + "\n")


@pytest.fixture
def study(tmp_path):
    """A plan whose runs are written by hand: seeds 1, 11 and 12 learned, 13 did not, 14 failed."""
    (tmp_path / "tiny.toml").write_text(TABLE)
    wanted = table.read(tmp_path / "tiny.toml")
    made = plan.Plan.__new__(plan.Plan)
    made.table, made.out = wanted, tmp_path / "study"
    fingerprint = plan.fingerprint_of(SETTINGS, DIGESTS)
    made.runs = [
        plan.Run(wanted.cases[0], seed, fingerprint, [], {"greedy": (f"greedy-{seed}", [])})
        for seed in (1, 11, 12, 13, 14)
    ]
    rows = {
        1: [("goal", 7)] * 80,
        11: [("timeout", 60)] * 5 + [("goal", 7)] * 75,
        12: [("timeout", 60)] * 9 + [("goal", 7)] * 21 + [("goal", 12)] * 50,
        13: [("tumble", 3)] + [("goal", 12)] * 79,
    }
    for run in made.runs[:-1]:
        write_episodes(made.folder(run), rows[run.seed])
        manifest = {
            "settings": SETTINGS,
            "digests": DIGESTS,
            "wall_time_s": 9.5,
            "machine": {"cpu": "Some CPU", "cores": 4},
            "revision": {"commit": "a" * 40, "dirty": False},
        }
        (made.folder(run) / "manifest.json").write_text(json.dumps(manifest))
        evaluation = made.evaluation_folder(run, "greedy")
        write_episodes(evaluation, [("goal", 33)])
        (evaluation / "manifest.json").write_text(json.dumps({"digests": DIGESTS}))
    (made.out / "logs").mkdir()
    (made.out / "logs" / f"{made.runs[-1].name}.log").write_text("It broke.\n")
    return made


@pytest.fixture
def page(study):
    markdown, html = report.write_report(study)
    return SimpleNamespace(out=study.out, markdown=markdown.read_text(), html=html.read_text())


def test_test_seeds_and_tuning_seeds_are_named_and_apart(page):
    assert "Tuning seeds: 1. Test seeds: 11-14." in page.markdown
    test, _, tuning = page.markdown.partition("## On tuning seeds")
    assert "| learner-locked-flat | 2 of 3 (9% to 99%) | 8 (4 to never) | never | " in test
    assert "| learner-locked-flat | 1 of 1 (3% to 100%) | 0 | 0 | 100% | 1 of 1 | 0.0 | 7.00 s |" in tuning


def test_evaluations(page):
    assert "| learner-locked-flat | greedy | 3 | 3 of 3 | 33.0 s | 0.020 m | 0.020 m |" in page.markdown


def test_every_seed_has_its_row_and_every_case_its_figure(page):
    assert "| 11 (test) | 4 | 100% | 4.0 | 7.00 s | 0.020 m | 0 | 0:10 | greedy: 100% goals" in page.markdown
    assert "| 13 (test) | never |  |  | 12.00 s | 0.020 m | 1 | 0:10 |" in page.markdown
    for name in ("learned", "learner-locked-flat"):
        assert f"](figures/{name}.png)" in page.markdown
        assert (page.out / "figures" / f"{name}.png").stat().st_size > 10_000


def test_failed_run_is_told_of_and_not_counted(page):
    assert "## Not counted" in page.markdown
    assert "| learner-locked-flat | 14 | run | failed: It broke. |" in page.markdown


def test_html_says_the_same(page):
    cells = [cell for line in page.markdown.splitlines() if line.startswith("| ") for cell in line[2:-2].split(" | ")]
    assert cells
    for cell in cells:
        assert f">{cell.strip()}</t" in page.html
    assert '<img src="figures/learned.png"' in page.html


def test_run_that_is_not_what_its_name_says_does_not_count(study):
    manifest = study.folder(study.runs[1]) / "manifest.json"
    manifest.write_text(manifest.read_text().replace('"simulator": "2"', '"simulator": "9"'))
    markdown, _ = report.write_report(study)
    assert "| learner-locked-flat | 11 | run | robot or programs were changed while the study" in markdown.read_text()


def test_evaluation_by_other_programs_does_not_count(study):
    manifest = study.evaluation_folder(study.runs[1], "greedy") / "manifest.json"
    manifest.write_text(json.dumps({"digests": {}}))
    markdown, _ = report.write_report(study)
    assert "| learner-locked-flat | 11 | greedy | robot or programs were changed" in markdown.read_text()
    assert "| learner-locked-flat | greedy | 2 | 2 of 2 |" in markdown.read_text()


def test_what_the_tables_hold_is_escaped():
    blocks = [document.Table(["a|b"], [["<c>"]])]
    assert document.markdown(blocks) == "| a\\|b |\n|---|\n| <c> |\n"
    assert "<th>a|b</th>" in document.html("title", blocks)
    assert "<td>&lt;c&gt;</td>" in document.html("title", blocks)
