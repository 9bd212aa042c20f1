"""compare tells what is in the run folders, in 80 columns, as JSON and as CSV, and draws it."""

import csv
import io
import json
import sys
from pathlib import Path

import pytest

from limphome_lab.show import experiments

pytest.importorskip("scipy")

sys.path.insert(0, str(Path(__file__).parents[1] / "show"))
from test_experiments import make_run

from limphome_lab.study import compare


@pytest.fixture
def runs(tmp_path):
    """Two experiments: seeds 1 to 3 of one learned, of the other seed 1 did and seed 2 never reached its goals."""
    for seed in (1, 2, 3):
        make_run(tmp_path / f"good{seed}", seed, config="[failure]\nmode = free\n")
    make_run(tmp_path / "poor1", 1, config="[failure]\nmode = locked\n")
    poor = make_run(tmp_path / "poor2", 2, config="[failure]\nmode = locked\n")
    (poor / "episodes.csv").write_text((poor / "episodes.csv").read_text().replace("goal,14,7.5", "timeout,14,1000"))
    return tmp_path


def found(runs):
    grouped, told = experiments.group(experiments.find([runs])[0])
    return grouped, [compare.compared(each, hard=False) for each in grouped], told


def test_seeds_that_learned_are_counted_with_an_exact_interval(runs):
    _, (good, poor), _ = found(runs)
    assert (good["learned"], good["runs"]) == (3, 3) and (poor["learned"], poor["runs"]) == (1, 2)
    # all of 3: the lower end p of Clopper and Pearson's has p^3 = 0.025
    assert good["learned_share_95"] == pytest.approx([0.025 ** (1 / 3), 1], abs=1e-9)
    assert [seed["n"] for seed in poor["seeds"]] == [0, None]
    assert good["quartiles_n"] == [0, 0, 0] and poor["quartiles_n"] == [None, None, None]
    assert good["quartiles_lateral_error_m"] == pytest.approx([0.015, 0.02, 0.025])
    assert poor["quartiles_duration_s"] == pytest.approx([255.625, 503.75, 751.875])


def test_never_is_above_all_others():
    assert compare.spread([3, None, 5, 4], "n") == [3.75, 4.5, None]
    assert compare.spread([3, None, 4], "n") == [3.5, 4, None]


def test_the_text_fits_80_columns_and_shows_every_seed(runs):
    _, both, told = found(runs)
    text = compare.text(both, told)
    assert all(len(line) < 80 for line in text.splitlines())
    assert "note: not the same task: other failure.mode" in text
    assert "A  failure.mode=free" in text and "B  failure.mode=locked" in text
    assert sum(line.strip().startswith(("1 ", "2 ", "3 ")) for line in text.splitlines()) == 5
    assert "never" in text


def test_the_table_has_a_row_for_each_seed(runs):
    _, both, _ = found(runs)
    stream = io.StringIO()
    compare.write_csv(both, stream)
    rows = list(csv.DictReader(io.StringIO(stream.getvalue())))
    assert [(row["experiment"], row["failure.mode"], row["seed"]) for row in rows] == [
        *(("A", "free", seed) for seed in "123"),
        *(("B", "locked", seed) for seed in "12"),
    ]
    assert rows[-1]["n"] == ""


def test_it_can_be_read_as_json(runs):
    _, both, _ = found(runs)
    assert json.loads(json.dumps(both, allow_nan=False)) == both


def test_figures_are_drawn_for_the_screen_and_for_a_paper(runs, tmp_path):
    grouped, both, _ = found(runs)
    files = compare.draw(grouped, both, tmp_path / "out", paper=True)
    names = {str(file.relative_to(tmp_path / "out")) for file in files}
    assert names == {f"{name}.png" for name in ("compared", "courses")} | {
        f"paper/{name}.{kind}" for name in ("compared", "courses") for kind in ("pdf", "png")
    }
    assert all(file.stat().st_size > 5000 for file in files)
