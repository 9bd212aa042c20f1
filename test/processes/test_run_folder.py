"""What a run leaves agrees with itself: table, recording, policy, checkpoints, manifest, figures."""

import json
from collections import Counter
from itertools import pairwise

import pytest

from limphome import checkpoint_t, policy_t, status_t
from limphome_lab.channels import DECISION, EPISODE, POLICY, STATE, STATUS
from limphome_lab.messages import OUTCOMES, recorded

EPISODES, RESET_EVERY = 30, 10  # of config/smoke.ini
PRINTED = 1e-8  # relative: episodes.csv has nine digits
ROUNDING = 2.0**-24  # relative, of one addition in single precision, in which the controller sums
REWARDS = ("reward_motion", "reward_goal", "reward_stability", "reward_tumble")


def learned_steps(decisions):
    """(episode, decision that tells of it) for every step: a decision tells of the step that led to its state, so of
    the episode that the decision before it was taken in."""
    for before, decision in pairwise(decisions):
        if decision.learned:
            yield before.episode, decision


@pytest.fixture(scope="module")
def messages(smoke_run):
    """{channel: [message]} of the whole recording."""
    found = {}
    for channel, message in recorded(smoke_run.messages, DECISION, EPISODE, POLICY, STATE, STATUS):
        found.setdefault(channel, []).append(message)
    return found


def test_one_row_per_episode(smoke_run):
    assert [row.episode for row in smoke_run.read_episodes()] == list(range(1, EPISODES + 1))


def test_rows_are_the_episode_messages(smoke_run, messages):
    for row, message in zip(smoke_run.read_episodes(), messages[EPISODE], strict=True):
        assert (row.episode, row.outcome, row.steps) == (message.episode, OUTCOMES[message.outcome], message.steps)
        in_row = [
            row.duration_s,
            row.reward,
            *(getattr(row, name) for name in REWARDS),
            row.lateral_error_m,
            row.heading_change_rad,
            row.temperature,
        ]
        in_message = [
            message.duration,
            message.reward,
            *(getattr(message, name) for name in REWARDS),
            message.lateral_error,
            message.heading_change,
            message.temperature,
        ]
        assert in_row == pytest.approx(in_message, rel=PRINTED)


def test_reward_is_the_sum_of_its_terms(smoke_run):
    for row in smoke_run.read_episodes():
        terms = [getattr(row, name) for name in REWARDS]
        bound = (len(terms) * ROUNDING + PRINTED) * sum(map(abs, terms))
        assert row.reward == pytest.approx(sum(terms), abs=bound)


def test_every_step_of_an_episode_is_learned_from_once(smoke_run, messages):
    learned = Counter(episode for episode, _ in learned_steps(messages[DECISION]))
    assert learned == {row.episode: row.steps for row in smoke_run.read_episodes()}


def test_no_state_is_decided_on_twice(messages):
    decided = Counter((decision.session, decision.seq) for decision in messages[DECISION])
    assert max(decided.values()) == 1
    assert set(decided) == {(state.session, state.seq) for state in messages[STATE]}


@pytest.mark.parametrize("name", REWARDS)
def test_rewards_of_the_decisions_add_up_to_the_episode(smoke_run, messages, name):
    terms = {}
    for episode, decision in learned_steps(messages[DECISION]):
        terms.setdefault(episode, []).append(getattr(decision, name))
    for row in smoke_run.read_episodes():
        of_episode = terms[row.episode]
        bound = (len(of_episode) * ROUNDING + PRINTED) * sum(map(abs, of_episode))
        assert getattr(row, name) == pytest.approx(sum(of_episode), abs=bound)


def test_policy_is_the_last_policy_message(smoke_run, messages):
    assert smoke_run.policy.read_bytes() == messages[POLICY][-1].encode()
    assert policy_t.decode(smoke_run.policy.read_bytes()).episode == EPISODES


def test_checkpoints_lie_where_the_plant_was_reset(smoke_run, messages):
    files = sorted(smoke_run.checkpoints.iterdir())
    expected = range(RESET_EVERY, EPISODES + 1, RESET_EVERY)
    assert [file.name for file in files] == [f"episode_{number:06}.lcm" for number in expected]
    for file, number in zip(files, expected, strict=True):
        checkpoint = checkpoint_t.decode(file.read_bytes())
        assert checkpoint.policy.episode == number
        assert checkpoint.policy.encode() in [policy.encode() for policy in messages[POLICY]]


def test_sessions_change_where_the_plant_was_reset(smoke_run, messages):
    session_of = {episode.episode: episode.session for episode in messages[EPISODE]}
    for row in smoke_run.read_episodes()[:-1]:
        is_reset = row.episode % RESET_EVERY == 0 or row.outcome == "tumble"
        assert (session_of[row.episode] != session_of[row.episode + 1]) == is_reset


def test_recording_holds_the_status_of_both_processes(messages):
    assert {status.process for status in messages[STATUS]} == {status_t.PLANT, status_t.CONTROLLER}


def test_status_tells_each_limit_that_acted(messages):
    last = [status for status in messages[STATUS] if status.process == status_t.CONTROLLER][-1]
    each = [
        last.clamped_inputs,
        last.clamped_temperatures,
        last.clamped_margins,
        last.clamped_weights,
        last.clamped_widths,
        last.clamped_centres,
    ]
    assert last.clamped_inputs > 0  # joints rest on their stops
    assert last.clamped == sum(each)


def test_manifest_tells_what_it_took(smoke_run):
    manifest = json.loads(smoke_run.manifest.read_text())
    rows = smoke_run.read_episodes()
    assert (manifest["config"], manifest["seed"], manifest["result"]) == ("smoke", 1, "finished")
    assert manifest["episodes"] == EPISODES
    assert manifest["outcomes"] == dict(Counter(row.outcome for row in rows))
    assert manifest["decisions"] >= sum(row.steps for row in rows)
    assert manifest["simulated_time_s"] > 0 and manifest["wall_time_s"] > 0
    shares = [manifest[f"{part}_share"] for part in ("simulator", "controller", "link")]
    assert all(0 <= share <= 1 for share in shares)
    assert sum(shares) >= 1 - 1e-3  # the controller writes while the simulator goes on
    assert manifest["versions"]["lcm"] and manifest["versions"]["bullet"] and manifest["versions"]["compiler"]


def test_run_was_given_every_setting(smoke_run):
    settings = smoke_run.settings()
    assert settings["learning"]["episodes"] == str(EPISODES)
    assert settings["simulator"]["pace"] == "lockstep"
    assert settings["rbf"]["units"] == "50"


def test_figures_are_images(smoke_run):
    names = {file.name for file in smoke_run.figures.iterdir()}
    assert names == {f"{name}.png" for name in ("fig7_trajectories", "fig8_reward", "fig9_motion", "fig_learning")}
    for file in smoke_run.figures.iterdir():
        assert file.read_bytes().startswith(b"\x89PNG\r\n") and file.stat().st_size > 10_000
