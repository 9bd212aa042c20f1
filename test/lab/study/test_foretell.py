"""scripts/study --foretell: what one run of each case costs, times what the table asks for."""

import subprocess
import sys

import pytest

from limphome_lab import paths
from limphome_lab.ending import Ending, InputError
from limphome_lab.study import foretell
from limphome_lab.study.foretell import Cost


@pytest.mark.parametrize("text", ["", "64", "64x", "0x2", "2x0", "-1x2", "2 x 2", "2x2x2", "manyx2"])
def test_machine_that_is_none_is_refused(text):
    with pytest.raises(InputError, match="nodes x cores"):
        foretell.machine(text)


def test_machine_that_has_no_name_makes_no_study(tmp_path):
    words = [sys.executable, "-m", "limphome_lab.study.study", paths.CONFIG / "studies" / "smoke.toml"]
    words += ["--foretell", "", "--out", tmp_path / "study"]
    result = subprocess.run(words, capture_output=True, text=True, timeout=20)
    assert result.returncode == 2
    assert "nodes x cores" in result.stderr
    assert not (tmp_path / "study").exists()


def test_machine():
    assert foretell.machine("64x32") == (64, 32)


def test_profile_tells_how_many_jobs_there_may_be(tmp_path):
    (tmp_path / "config.yaml").write_text("executor: slurm\njobs: 200 # at a time\n")
    assert foretell.jobs_at_a_time(tmp_path) == 200
    (tmp_path / "config.yaml").write_bytes(b"# caf\xe9\njobs: 200\n")
    assert foretell.jobs_at_a_time(tmp_path) == 200
    (tmp_path / "config.yaml").write_text("executor: slurm\n")
    assert foretell.jobs_at_a_time(tmp_path) is None
    with pytest.raises(InputError, match=r"no profile of Snakemake: No such file"):
        foretell.jobs_at_a_time(tmp_path / "none")


def test_job_is_measured_by_what_it_makes_and_the_time_its_core_works(tmp_path):
    program = """
import pathlib, sys, time
out = pathlib.Path(sys.argv[-1])
out.mkdir()
(out / "file").write_bytes(bytes(10000))
while time.process_time() < 0.2:
    pass
"""
    cost = foretell.measured([sys.executable, "-c", program], tmp_path / "run")
    assert cost.jobs == 1 and cost.files == 2
    assert cost.bytes >= 10000
    assert cost.core_s >= 0.2


def test_job_that_fails_is_told_with_its_words(tmp_path):
    with pytest.raises(Ending, match=r"exit code 3:\nno luck"):
        foretell.measured(
            [sys.executable, "-c", "import sys; print('no luck', file=sys.stderr); sys.exit(3)"], tmp_path
        )


def test_cores_share_the_work_and_no_seed_is_shared():
    seed = Cost(core_s=100.0, files=7, bytes=1000, jobs=1)
    all_seeds = foretell.total([seed], 60)
    assert vars(all_seeds) == {"core_s": 6000.0, "files": 420, "bytes": 60000, "jobs": 60}
    start, before = foretell.LOCAL_JOB_S, foretell.STUDY_S + 60 * foretell.PLANNED_JOB_S
    assert foretell.wall_s(all_seeds, seed, 10, slurm=False) == pytest.approx(6 * (100.0 + start) + before)
    assert foretell.wall_s(all_seeds, seed, 1000, slurm=False) == pytest.approx(100.0 + start + before)


def test_many_short_jobs_take_as_long_as_to_submit_them():
    job = Cost(core_s=0.1, files=1, bytes=1, jobs=1)
    wall = foretell.wall_s(job * 100_000, job, 1_000_000, slurm=True)
    submitting = 100_000 * (foretell.SLURM_SUBMIT_S + foretell.PLANNED_JOB_S)
    assert wall == pytest.approx(submitting + foretell.SLURM_STATUS_S + foretell.STUDY_S)


def test_tells_what_a_table_costs(tmp_path, monkeypatch, capsys):
    from limphome_lab.study import table

    file = tmp_path / "many.toml"
    file.write_text(
        '[seeds]\ntest = ["1-10000"]\n[variants.planner]\n'
        '[failures.left_locked]\nfailure.mode = "locked"\n[grounds.flat]\n[evaluations.greedy]\n'
    )
    (tmp_path / "config.yaml").write_text("jobs: 200\n")
    a_seed = Cost(core_s=36.0, files=20, bytes=1_000_000, jobs=2)
    monkeypatch.setattr(foretell, "of_each_case", lambda wanted, together: [a_seed])
    foretell.tell(table.read(file), "64x32", tmp_path, together=True)
    said = capsys.readouterr().out
    assert "10000, with evaluations 20000 jobs" in said
    assert "disk        10 GB" in said
    assert "files       260024" in said
    assert "jobs: 200 leaves 1848 of 2048 cores idle" in said
