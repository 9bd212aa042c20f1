"""What scripts/robot --template writes learns with the defaults."""

from conftest import run_script
from limphome_lab.runfolder import RunFolder


def test_a_template_reaches_its_goals_from_the_first_episode_on(tmp_path):
    file = tmp_path / "mine.urdf"
    file.write_text(run_script("robot", "--template", "--length", 1.2, "--arm", "0.9,0.7").stdout)
    run_script("train", "--robot", file, "--episodes", 3, "--out", tmp_path / "run", "--quiet", "--no-figures")
    assert [episode.outcome for episode in RunFolder(tmp_path / "run").read_episodes()] == ["goal"] * 3
