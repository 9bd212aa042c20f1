"""The environment for learners of others: the same task, to the bit, as our own learners have; seeds; clean ends."""

import gc
import itertools
import os
import re
import signal
import subprocess
import sys
import time
import warnings

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from conftest import ROOT, SMOKE, TIME_LIMIT_S, geared_robot, train
from limphome_lab import network
from limphome_lab.channels import DECISION, EPISODE
from limphome_lab.ending import InputError
from limphome_lab.gym import ID, LimpHome, LimpHomeVector
from limphome_lab.gym.plant import PlantEnded
from limphome_lab.messages import OUTCOMES, recorded
from limphome_lab.registry import process_start
from limphome_lab.runfolder import RunFolder

TOLD_ALIKE = [  # by decision_t and info
    "reward_motion",
    "reward_goal",
    "reward_stability",
    "reward_tumble",
    "stability_margin",
    "goal_distance",
    "lateral_error",
    "heading_error",
    "waypoint_distance",
    "step",
]
SHORT = {"episode.step_limit": 20, "episode.reset_every": 2}
NOISY = ROOT / "config" / "imperfect.ini"


@pytest.fixture
def make():
    """Makes environments that are closed at the end of the test."""
    made = []

    def make_one(kind=LimpHome, **arguments):
        made.append(kind(**arguments))
        return made[-1]

    yield make_one
    for each in made:
        each.close()


def simulator_of(env):
    """Process id."""
    return env._session._plant._child.process.pid


def gone(pid):
    """Whether the process ends; looked at for a while."""
    deadline = time.monotonic() + TIME_LIMIT_S
    while process_start(pid) is not None and time.monotonic() < deadline:
        time.sleep(0.02)
    return process_start(pid) is None


def drive(env, actions, seed):
    """All that is told from the reset on, episode after episode."""
    told = [env.reset(seed=seed)]
    for action in actions:
        told.append(env.step(action))
        if told[-1][2] or told[-1][3]:
            told.append(env.reset())
    return [(each[0].tolist(), *each[1:]) for each in told]


def actions_of(seed, count=60):
    return np.random.default_rng(seed).integers(0, 81, count).tolist()


def test_it_passes_gymnasiums_check():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        env = gymnasium.make(ID, line=True)
        check_env(env.unwrapped)
        env.close()


@pytest.mark.parametrize("failed", ["left_crawler", "none"])
def test_a_recorded_run_is_rewarded_alike(tmp_path, make, failed):
    """The actions of a training of ours, rewarded and ended here to the bit as there."""
    settings = {"failure.actuator": failed, "episode.step_limit": 40, "episode.reset_every": 4, "learning.episodes": 12}
    # that tumbles and goals come, too
    settings |= {"episode.tumble_tilt_rad": 0.12, "episode.goal_distance_m": 0.3}
    words = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
    train(tmp_path / "run", "--seed", 3, *words)
    folder = RunFolder(tmp_path / "run")
    decisions = [message for _, message in recorded(folder.messages, DECISION)]
    episodes = {message.episode: message for _, message in recorded(folder.messages, EPISODE)}
    env = make(config=SMOKE, set=settings)
    inputs = env.observation_space.shape[0]
    seen, info = env.reset(seed=3)
    ends = set()
    for now, after in itertools.pairwise(decisions):
        assert seen.tolist() == list(now.inputs[:inputs])
        assert (info["episode_number"], info["step"]) == (now.episode, now.step)
        if now.num_inputs == inputs:  # nothing was chosen, but a reset asked for
            seen, info = env.reset()
            continue
        seen, reward, terminated, truncated, info = env.step(now.action)
        assert reward == np.float32(sum(np.float32(info[name]) for name in TOLD_ALIKE[:4]))
        rewards = [info[name] for name in TOLD_ALIKE[:4]]
        assert rewards == [getattr(after, name) for name in TOLD_ALIKE[:4]]
        if terminated or truncated:
            told = episodes[now.episode]
            assert (info["outcome"], info["step"]) == (OUTCOMES[told.outcome], told.steps)
            assert (terminated, truncated) == (info["outcome"] != "timeout", info["outcome"] == "timeout")
            same = ["lateral_error", "heading_change", "duration"]
            assert [info[name] for name in same] == [getattr(told, name) for name in same]
            ends.add(info["outcome"])
            if after.episode != now.episode:
                seen, info = env.reset()
        if info["step"] > 0:
            assert {name: info[name] for name in TOLD_ALIKE} == {name: getattr(after, name) for name in TOLD_ALIKE}
    assert ends == {"goal", "tumble", "timeout"}
    assert len(episodes) == 12


def test_a_seed_and_actions_decide_all(make):
    one, other = make(config=NOISY, set=SHORT, line=True), make(config=NOISY, set=SHORT, line=True)
    first = drive(one, actions_of(1), 5)
    assert drive(one, actions_of(1), 6) != first  # what is drawn at random is another
    assert drive(one, actions_of(1), 5) == first
    assert drive(other, actions_of(1), 5) == first


def test_a_reset_goes_on_where_the_robot_stands_or_puts_it_back(make):
    env = make(set=SHORT | {"episode.reset_every": 50})
    ends = [told for told in drive(env, [41] * 45, 1) if len(told) == 2]  # forward and nothing else
    assert [info["episode_number"] for _, info in ends] == [1, 2, 3]
    assert ends[1][1]["y"] != ends[0][1]["y"] and ends[2][1]["y"] != ends[1][1]["y"]
    _, info = env.reset()  # from the midst of one
    assert (info["episode_number"], info["y"]) == (4, ends[0][1]["y"])
    for _ in range(20):
        *_, truncated, _ = env.step(41)
    assert truncated
    assert env.reset(options={"put_back": True})[1]["y"] == ends[0][1]["y"]


def test_a_vector_does_what_its_environments_would_do(make):
    vector = make(LimpHomeVector, num_envs=2, config=NOISY, set=SHORT)
    alone = [make(config=NOISY, set=SHORT) for _ in range(2)]
    seen, _ = vector.reset(seed=4)
    assert seen.tolist() == [env.reset(seed=4 + i)[0].tolist() for i, env in enumerate(alone)]
    ended = [False, False]
    for actions in zip(actions_of(1, 50), actions_of(2, 50), strict=True):
        seen, rewards, terminations, truncations, infos = vector.step(np.array(actions))
        for i, env in enumerate(alone):
            if ended[i]:
                told = (env.reset()[0], 0.0, False, False)
            else:
                *told, info = env.step(actions[i])
                assert infos["lateral_error"][i] == info["lateral_error"]
                assert not (told[2] or told[3]) or infos["outcome"][i] == info["outcome"]
            assert (seen[i].tolist(), rewards[i], terminations[i], truncations[i]) == (told[0].tolist(), *told[1:])
            ended[i] = told[2] or told[3]
    assert vector.observation_space.contains(seen)


def test_the_vector_is_what_make_vec_makes():
    vector = gymnasium.make_vec(ID, num_envs=2, set={"failure.actuator": "none"})
    assert isinstance(vector, LimpHomeVector)
    assert vector.single_action_space.n == 3**5
    vector.close()


def test_a_python_for_each_comes_to_the_same(make):
    ours = make(LimpHomeVector, num_envs=2, config=NOISY, set=SHORT)
    theirs = gymnasium.make_vec(ID, num_envs=2, vectorization_mode="async", config=NOISY, set=SHORT)
    assert ours.reset(seed=4)[0].tolist() == theirs.reset(seed=4)[0].tolist()
    for action in actions_of(3, 5):
        actions = np.array([action, 80 - action])
        for ours_told, theirs_told in zip(ours.step(actions)[:4], theirs.step(actions)[:4], strict=True):
            assert ours_told.tolist() == theirs_told.tolist()
    theirs.close()


@pytest.mark.skipif(network.group_is_on_loopback(), reason="the host's network may be used here")
def test_where_nothing_may_be_sent_it_is_told(monkeypatch):
    monkeypatch.setattr(network, "private_prefix", lambda: None)
    with pytest.warns(UserWarning, match="namespaces"), pytest.raises(network.NetworkError, match="run once"):
        LimpHome()


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ({"set": {"failure.actuator": "wing"}}, "actuator = wing: .*left_crawler"),
        ({"set": {"reward.forwards": 1}}, "reward.forwards"),
        ({"config": "nowhere.ini"}, "nowhere.ini"),
        ({"robot": ROOT / "config" / "paper.ini"}, "paper.ini"),
        ({"set": {"simulator.pace": "real_time"}}, "simulator.pace"),
        ({"set": {"simulator.reset": "where_it_is"}}, "simulator.reset"),
        ({"set": {"safety.monitor": "on"}}, "safety.monitor"),
    ],
)
def test_what_is_bad_is_refused_with_the_words_of_the_programs(arguments, told):
    with pytest.raises(InputError, match=told):
        LimpHome(**arguments)


def test_calls_out_of_turn_are_refused(make):
    env = make()
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(0)
    env.reset()
    for action in (-1, 81):
        with pytest.raises(ValueError, match="must be 0 to 80"):
            env.step(action)
    env.step(0)
    with pytest.raises(InputError, match="must be 0 to 2147483647"):
        env.reset(seed=2**31)
    env.close()
    env.close()
    with pytest.raises(gymnasium.error.ClosedEnvironmentError):
        env.reset()


@pytest.mark.parametrize("action", [1.5, "1", np.float32(2), -1, 81])
def test_what_is_no_action_is_refused_and_changes_nothing(make, action):
    env, pair = make(set=SHORT), make(LimpHomeVector, num_envs=2, set=SHORT)
    env.reset()
    pair.reset()
    with pytest.raises((TypeError, ValueError)):
        env.step(action)
    with pytest.raises((TypeError, ValueError)):
        pair.step([4, action])
    assert env.step(np.array(4))[1] == pair.step([4, 4])[1][0], "the next is the first that is taken"


def test_a_vector_has_one_environment_at_least_and_a_mask_for_all(make):
    with pytest.raises(ValueError, match="0 environments: must be at least 1"):
        LimpHomeVector(0)
    with pytest.raises(ValueError, match="reset_mask"):
        make(LimpHomeVector, num_envs=2, set=SHORT).reset(options={"reset_mask": np.array([True])})


def test_a_simulator_that_dies_is_told(make):
    env = make()
    env.reset()
    os.kill(simulator_of(env), signal.SIGKILL)
    with pytest.raises(PlantEnded, match=r"ended early \(signal SIGKILL\)"):
        env.step(0)


def test_a_simulation_that_diverges_ends_the_episode_and_goes_on(tmp_path, make):
    env = make(robot=geared_robot(tmp_path), set={"failure.actuator": "none"})
    still, drive = 121, 124  # the right crawler
    first, _ = env.reset()
    assert "outcome" not in env.step(still)[4]
    *told, info = env.step(drive)
    assert told[1:] == [0.0, False, True] and info["outcome"] == "fault"
    assert told[0].tolist() == first.tolist()
    _, info = env.reset()
    assert info["episode_number"] == 2
    assert not any(env.step(still)[2:4])


def test_no_simulator_is_left():
    env = LimpHome()
    pid = simulator_of(env)
    env.close()
    assert gone(pid)
    env = LimpHome()
    pid = simulator_of(env)
    del env
    gc.collect()
    assert gone(pid)


@pytest.mark.parametrize("end", ["", "os.kill(os.getpid(), signal.SIGKILL)", "os._exit(0)", "raise KeyboardInterrupt"])
def test_no_simulator_outlives_its_process(end):
    code = f"""import os, signal; from limphome_lab.gym import LimpHomeVector
env = LimpHomeVector(2); env.reset()
print(*(each._plant._child.process.pid for each in env._sessions), flush=True)
{end}"""
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=TIME_LIMIT_S)
    pids = [int(word) for word in result.stdout.split()]
    assert len(pids) == 2, result.stderr
    assert all(gone(pid) for pid in pids)


def test_the_example_of_the_page_runs(tmp_path):
    page = (ROOT / "docs" / "environment.md").read_text()
    code = re.search(r"```python\n(.*?)```", page, re.DOTALL)[1]
    result = subprocess.run([sys.executable, "-W", "error", "-c", code], capture_output=True, text=True, cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    assert "goal" in result.stdout or "timeout" in result.stdout
