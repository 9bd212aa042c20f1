"""Runs are told apart by what they were made with, and those that differ in their seed alone are one experiment."""

import json

import pytest

from limphome_lab.runfolder import Episode, InputError
from limphome_lab.show import experiments
from limphome_lab.show.figures import courses

CRAWLER = '<?xml version="1.0"?>\n<!-- a robot -->\n<robot name="crawler"></robot>'


def make_run(path, seed=1, robot=CRAWLER, config="", manifest=None, episodes=30):
    path.mkdir(parents=True)
    (path / "config.ini").write_text(f"[learning]\nseed = {seed}\nepisodes = {episodes}\n{config}")
    (path / "robot.urdf").write_text(robot)
    (path / "manifest.json").write_text(json.dumps({"result": "finished", "kind": "training"} | (manifest or {})))
    rows = [f"{n},goal,14,7.5,10,1,2,3,0,{0.01 * seed},0.01,1" for n in range(1, episodes + 1)]
    (path / "episodes.csv").write_text("\n".join([",".join(Episode.__dataclass_fields__), *rows]) + "\n")
    return path


def grouped(*paths):
    return experiments.group(experiments.find(paths)[0])


def test_seeds_of_one_experiment_are_together_in_their_order(tmp_path):
    (one,), told = grouped(*(make_run(tmp_path / f"run{seed}", seed) for seed in (3, 1, 2)))
    assert [run.seed for run in one.runs] == [1, 2, 3]
    assert one.name == "" and told == []


def test_experiments_are_named_after_the_keys_that_differ(tmp_path):
    runs = [
        make_run(tmp_path / "a", config="[failure]\nmode = locked\n[reward]\ngoal = 10\n"),
        make_run(tmp_path / "b", config="[failure]\nmode = free\n[reward]\ngoal = 10.0\n"),
    ]
    found, told = grouped(*runs)
    assert [(each.letter, each.name) for each in found] == [("A", "failure.mode=locked"), ("B", "failure.mode=free")]
    assert told == ["not the same task: other failure.mode"]


def test_what_differs_between_learners_alone_is_the_same_task(tmp_path):
    found, told = grouped(
        make_run(tmp_path / "a", config="[learner]\nkind = planner\n"),
        make_run(tmp_path / "b", config="[learner]\nkind = q_learning\n", episodes=60),
    )
    assert len(found) == 2 and told == []


def test_another_robot_is_another_experiment_whatever_its_name(tmp_path):
    half = CRAWLER.replace("crawler", "half")
    twin = CRAWLER + "<!-- heavier -->"
    found, told = grouped(
        make_run(tmp_path / "a"), make_run(tmp_path / "b", robot=half), make_run(tmp_path / "c", robot=twin)
    )
    assert [each.differs["robot"] for each in found] == ["crawler(a)", "half", "crawler(c)"]
    assert told == ["not the same task: other robot"]


def test_an_evaluation_is_not_mixed_with_trainings(tmp_path):
    found, _ = grouped(make_run(tmp_path / "a"), make_run(tmp_path / "b", 2, manifest={"kind": "evaluation"}))
    assert [each.name for each in found] == ["kind=training", "kind=evaluation"]


def test_one_seed_does_not_count_twice(tmp_path):
    (one,), told = grouped(make_run(tmp_path / "a"), make_run(tmp_path / "b"))
    assert len(one.runs) == 1 and told == ["passed over b: a is the same, seed too"]


def test_other_builds_are_told(tmp_path):
    _, told = grouped(
        make_run(tmp_path / "a", 1, manifest={"digests": {"controller": "1", "robot": "r"}}),
        make_run(tmp_path / "b", 2, manifest={"digests": {"controller": "2", "robot": "r"}}),
    )
    assert told == ["made by 2 builds of the programs"]


def test_what_has_not_finished_is_passed_over(tmp_path):
    make_run(tmp_path / "runs" / "a")
    make_run(tmp_path / "runs" / "b", 2, manifest={"result": "interrupted"})
    (make_run(tmp_path / "runs" / "c", 3) / "manifest.json").unlink()
    runs, told = experiments.find([tmp_path / "runs"])
    assert [run.seed for run in runs] == [1]
    assert "b: the run has not finished" in told[0] and "manifest.json is missing" in told[1]


def test_a_study_gives_its_runs_and_not_its_evaluations(tmp_path):
    make_run(tmp_path / "runs" / "a")
    make_run(tmp_path / "evaluations" / "b")
    (tmp_path / "plan.json").write_text("{}")
    runs, _ = experiments.find([tmp_path])
    assert [run.folder.path.name for run in runs] == ["a"]


@pytest.mark.parametrize("name", ["", "nowhere"])
def test_a_folder_without_runs_is_refused(tmp_path, name):
    with pytest.raises(InputError, match="neither a run folder, nor a folder that has some"):
        experiments.find([tmp_path / name])


def test_letters_go_on_after_z():
    assert [experiments.letter(number) for number in (0, 25, 26, 27, 52)] == ["A", "Z", "AA", "AB", "BA"]


def test_a_figure_names_no_more_keys_than_tell_all_apart():
    differs = [{"a.x": x, "b.y": y, "c.z": z} for x, y, z in (("1", "1", "p"), ("1", "2", "q"), ("1", "2", "r"))]
    assert courses.telling_keys(differs) == ["c.z"]
    assert len(courses.telling_keys([{"a": p, "b": q} for p in "12" for q in "12"])) == 2
