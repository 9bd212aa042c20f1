"""Diagnosis of run folders made by hand."""

from dataclasses import asdict, fields

import lcm
import pytest

from limphome import decision_t, episode_t, robot_state_t, status_t
from limphome_lab.channels import DECISION, EPISODE, STATE, STATUS
from limphome_lab.runfolder import Episode, RunFolder
from limphome_lab.show import diagnose

CONFIG = """
[learner]
kind = q_learning
[learning]
episodes = 20
[rbf]
gradient = exact
[action]
crawler_speed = 0.3
joint_speed = 0.3
[reward]
forward = 8
[exploration]
temperature_floor = 0.01
[episode]
decision_period_s = 0.5
step_limit = 4
[simulator]
time_step_s = 0.005
"""
STEPS = 4


def state(number, x):
    message = robot_state_t()
    message.utime, message.session, message.seq = number * 500_000, 7, number
    message.position[0], message.orientation[0], message.num_actuators = x, 1.0, 5
    return message


def decision(probability=0.9):
    message = decision_t()
    message.learned, message.probability = 1, probability
    return message


def ended(number):
    message = episode_t()
    message.session, message.episode, message.outcome = 7, number, episode_t.TIMEOUT
    message.utime, message.duration, message.goal_distance = number * STEPS * 500_000, STEPS * 0.5, 2.0
    return message


def plant_status(time, saturated):
    message = status_t()
    message.process, message.simulated_time, message.saturated = status_t.PLANT, time, saturated
    return message


def run_folder(path, rows, pace=0.0):
    """A run of `rows`, each with the messages of 4 decisions of `pace` m."""
    folder = RunFolder(path)
    folder.config.write_text(CONFIG)
    lines = [",".join(field.name for field in fields(Episode))]
    lines += [",".join(str(value) for value in asdict(row).values()) for row in rows]
    folder.episodes.write_text("\n".join(lines) + "\n")
    messages = [(STATUS, plant_status(0, 0)), (STATE, state(0, 0.0))]
    for number in range(1, len(rows) + 1):
        for step in range(1, STEPS + 1):
            last = (number - 1) * STEPS + step
            messages += [(DECISION, decision()), (STATE, state(last, last * pace)), (STATE, state(last, last * pace))]
        messages += [(DECISION, decision(probability=0.0)), (EPISODE, ended(number))]
    messages.append((STATUS, plant_status(len(rows) * 2.0, len(rows) * 1000)))
    log = lcm.EventLog(str(folder.messages), "w")
    for time, (channel, message) in enumerate(messages):
        log.write_event(time, channel, message.encode())
    log.close()
    return folder


def row(number, outcome="timeout", lateral_error_m=0.02):
    return Episode(number, outcome, STEPS, 7.0, 0, 0, 0, 0, 0, lateral_error_m, 0.01, 0.25)


def rows(count, **more):
    return [row(number, **more) for number in range(1, count + 1)]


def test_run_that_learned(tmp_path):
    diagnosis = diagnose.diagnose(run_folder(tmp_path, rows(30, outcome="goal")))
    assert (diagnosis["learned_at"], diagnosis["held"], diagnosis["findings"]) == (0, 1, [])
    assert diagnose.text(diagnosis) == (
        "learned at 0 (0.0 robot minutes), held in 100% since\n"
        "last 20 episodes: 20 goals, 0 tumbles, 7.0 s, 0.02 m beside the line, 0.01 rad of turn"
    )


def test_run_that_reaches_its_goals_but_not_straight(tmp_path):
    folder = run_folder(tmp_path, rows(20, outcome="goal", lateral_error_m=0.22))
    text = diagnose.text(diagnose.diagnose(folder))
    assert text.startswith("reaches its goals, but")
    assert "0.22 m beside the line (at most 0.1)" in text
    assert diagnose.in_a_line(folder) is None


def test_run_that_stands(tmp_path):
    folder = run_folder(tmp_path, rows(25))
    diagnosis = diagnose.diagnose(folder)
    found = {finding["name"]: finding for finding in diagnosis["findings"]}
    assert list(found) == ["standing", "exploration ended", "saturated drives", "a goal that cannot be reached"]
    assert found["standing"]["numbers"] == {"farthest_m": 0, "share": 1}
    assert found["exploration ended"]["numbers"]["num_actions"] == pytest.approx(1 / 0.9)
    assert found["saturated drives"]["numbers"]["share"] == pytest.approx(0.5)  # 1000 of 2 s / 0.005 s * 5 drives
    text = diagnose.text(diagnosis)
    assert text.startswith("not learned\nlast 20 episodes: 0 goals")
    assert "\n    try exploration.temperature_floor above 0.25\n" in text


def test_run_that_moves_too_slowly(tmp_path):
    diagnosis = diagnose.diagnose(run_folder(tmp_path, rows(20), pace=0.1))
    found = {finding["name"]: finding["numbers"] for finding in diagnosis["findings"]}
    assert "standing" not in found and "never reaching" not in found
    assert found["a goal that cannot be reached"]["best_speed_m_s"] == pytest.approx(0.2)
    assert found["a goal that cannot be reached"]["goal_distance_m"] == 2


def test_few_episodes_are_too_few_to_tell(tmp_path):
    text = diagnose.text(diagnose.diagnose(run_folder(tmp_path, rows(3))))
    assert text.startswith("3 episodes are too few to tell whether it learned; 20 do\nlast 3 episodes: 0 goals")


def test_line_at_the_end_of_a_training(tmp_path):
    line = diagnose.in_a_line(run_folder(tmp_path, [row(1, "goal"), *rows(20)[1:]]))
    assert line.startswith(
        "1 of the last 20 episodes reached the goal: standing, exploration ended, saturated drives; "
    )
    assert line.endswith(f"diagnose {tmp_path} tells more")


@pytest.mark.parametrize(("goals", "count", "reaches"), [(19, 20, True), (18, 20, False), (3, 3, True), (2, 3, False)])
def test_goals_of_the_last_20(goals, count, reaches):
    assert (
        diagnose.reaches_its_goals(rows(5) * (count // 20) + rows(goals, outcome="goal") + rows(count - goals))
        is reaches
    )


def test_end_of_a_long_recording_tells_the_same_as_all_of_it(tmp_path, monkeypatch):
    folder = run_folder(tmp_path, rows(100), pace=0.1)
    begins = []
    recorded = diagnose._recorded
    monkeypatch.setattr(diagnose, "_recorded", lambda path, begin: begins.append(begin) or recorded(path, begin))
    diagnosis = diagnose.diagnose(folder)
    assert len(begins) == 1 and begins[0] > folder.messages.stat().st_size / 2
    ended, _ = recorded(folder.messages, 0)
    found = {finding["name"]: finding["numbers"] for finding in diagnosis["findings"]}
    assert found["a goal that cannot be reached"]["best_speed_m_s"] == pytest.approx(0.2)
    assert [len(states) for _, states, _ in ended] == [2 * STEPS + 1] * 21


def test_recording_whose_end_holds_too_little_is_read_from_its_beginning(tmp_path):
    folder = run_folder(tmp_path, rows(100))
    waited = tmp_path / "waited.lcmlog"
    log = lcm.EventLog(str(waited), "w")
    for time in range(10_000):  # a plant that waited long
        log.write_event(time, STATUS, plant_status(200.0, 100_000).encode())
    log.close()
    folder.messages.write_bytes(folder.messages.read_bytes() + waited.read_bytes())
    ended, _ = diagnose._recorded_end(folder, folder.read_episodes())
    assert [episode.episode for episode, _, _ in ended] == list(range(81, 101))


def test_recording_without_an_episode_is_refused(tmp_path):
    folder = run_folder(tmp_path, rows(3))
    folder.messages.write_bytes(b"")
    with pytest.raises(diagnose.runfolder.InputError, match="holds no episode"):
        diagnose.diagnose(folder)
