"""docs/results.md says what is in the run folders."""

import json

import pytest

from limphome_lab.runfolder import Episode, InputError
from limphome_lab.study import results

MANIFEST = {
    "config": "paper",
    "seed": 1,
    "result": "finished",
    "wall_time_s": 3725.0,
    "real_time_factor": 41.4,
    "decisions": 1234,
    "decisions_per_s": 20.6,
    "simulator_share": 0.77,
    "controller_share": 0.11,
    "link_share": 0.12,
    "revision": {"commit": "a" * 40, "dirty": True},
    "machine": {"cpu": "Some CPU", "cores": 4, "os": "Debian"},
}


def make_run(path, seed=1, **changes):
    """A run of 40 episodes: the first tenth tumbles, the rest gets better by the episode."""
    (path / "figures").mkdir(parents=True)
    for name in results.FIGURES:
        (path / "figures" / f"{name}.png").write_bytes(b"image of seed %d" % seed)
    for name in ("config.ini", "robot.urdf"):
        (path / name).write_text("")
    rows = [
        f"{n},{'tumble' if n <= 4 else 'goal'},{200 - n},{100 - n},{n - 20},0,0,0,0,{-1 / n},0,1" for n in range(1, 41)
    ]
    header = ",".join(Episode.__dataclass_fields__)
    (path / "episodes.csv").write_text("\n".join([header, *rows]) + "\n")
    (path / "manifest.json").write_text(json.dumps({**MANIFEST, "seed": seed, **changes}))
    return path


@pytest.fixture(autouse=True)
def docs(tmp_path, monkeypatch):
    monkeypatch.setattr(results, "DOCS", tmp_path / "docs")
    return tmp_path / "docs"


def test_table_compares_first_and_last_stretch(tmp_path):
    text = results.document([results.Run(make_run(tmp_path / "run"))])
    # medians over episodes 1..4 and 37..40
    assert "| 1 | 40 | 0 → 100 | 97.5 → 61.5 | 0.42 → 0.03 | -17.50 → 18.50 | 4 → 0 (4 in all) |" in text
    assert "| 1 | 1:02:05 | 41 | 1234 | 21 | 77% + 11% + 12% | `aaaaaaaaaa` with changes |" in text
    assert "First → last 4 episodes" in text


def test_runs_are_grouped_by_configuration_and_ordered_by_seed(tmp_path):
    runs = [make_run(tmp_path / "b", 2), make_run(tmp_path / "a", 1), make_run(tmp_path / "c", 1, config="other")]
    text = results.document([results.Run(path) for path in runs])
    headings = [line for line in text.splitlines() if line.startswith("## ")]
    assert headings == ["## other", "## paper"]
    assert text.index("| 1 | 40") < text.index("| 2 | 40")


def test_figures_are_copied_beside_the_page(tmp_path, docs):
    text = results.document([results.Run(make_run(tmp_path / "run", 7))])
    assert "](images/paper-seed7-fig8_reward.png)" in text
    assert (docs / "images" / "paper-seed7-fig8_reward.png").read_bytes() == b"image of seed 7"


def test_figures_are_those_of_the_seed_that_ended_best(tmp_path, docs):
    poor, good = make_run(tmp_path / "poor", 1), make_run(tmp_path / "good", 2)
    rows = (poor / "episodes.csv").read_text().splitlines()
    (poor / "episodes.csv").write_text(
        "\n".join(
            [*rows[:-4], *(row.replace("goal", "timeout").replace(row.split(",")[4], "-150") for row in rows[-4:])]
        )
        + "\n"
    )
    text = results.document([results.Run(poor), results.Run(good)])
    assert "](images/paper-seed2-fig8_reward.png)" in text
    assert "](images/paper-seeds.png)" in text
    assert (docs / "images" / "paper-seeds.png").stat().st_size > 10_000


def test_notes_are_taken_over(tmp_path, docs):
    docs.mkdir()
    (docs / "results_notes.md").write_text("What we make of it.\n")
    assert "\n\nWhat we make of it.\n\n" in results.document([results.Run(make_run(tmp_path / "run"))])


def test_run_that_has_not_finished_is_refused(tmp_path):
    with pytest.raises(InputError, match="not finished"):
        results.Run(make_run(tmp_path / "run", result="interrupted"))
