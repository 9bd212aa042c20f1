"""What is exported, read back by the formats' own libraries, against the recording: value for value."""

import csv
import json
import shutil

import numpy as np
import pyarrow.parquet
import pytest
from mcap.reader import make_reader

from conftest import run_script
from limphome_lab import robot
from limphome_lab.channels import DECISION, EPISODE, STATE
from limphome_lab.messages import OUTCOMES, TYPES
from limphome_lab.recording import HEADER, read_log
from limphome_lab.robot import rotation_of
from limphome_lab.runfolder import RunFolder
from limphome_lab.timeline import timeline


def export(run, name, *arguments):
    """Files that the script told."""
    return run_script("export", run.path, "--format", name, *arguments).stdout.split()


def recorded(run):
    """{channel: [(time [us], message)]}"""
    found = {}
    for time, channel, message in timeline(run.messages):
        found.setdefault(channel, []).append((time, message))
    return found


def topics(file):
    """{topic: [(log time [ns], JSON)]}, {topic: schema}"""
    found, schemas = {}, {}
    with open(file, "rb") as stream:
        for schema, channel, message in make_reader(stream).iter_messages(log_time_order=False):
            assert (channel.message_encoding, schema.encoding) == ("json", "jsonschema")
            schemas[channel.topic] = schema
            found.setdefault(channel.topic, []).append((message.log_time, json.loads(message.data)))
    return found, schemas


@pytest.fixture(scope="module")
def mcap(smoke_run, tmp_path_factory):
    (file,) = export(smoke_run, "mcap", "--out", tmp_path_factory.mktemp("mcap"))
    return topics(file)


@pytest.fixture(scope="module", params=["parquet", "csv"])
def tables(request, smoke_run, tmp_path_factory):
    """Rows of decisions and of episodes, as {column: value}; "" of a CSV is None."""
    files = export(smoke_run, request.param, "--out", tmp_path_factory.mktemp(request.param))
    return [rows(file) for file in files]


def rows(file):
    if file.endswith(".parquet"):
        return pyarrow.parquet.read_table(file).to_pylist()
    with open(file, newline="") as stream:
        return [{name: number(text) for name, text in row.items()} for row in csv.DictReader(stream)]


def number(text):
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text or None


def plain(value):
    return [plain(each) for each in value] if isinstance(value, (list, tuple)) else value


def test_mcap_has_every_message_of_the_recording_at_the_plants_time(smoke_run, mcap):
    found, _ = mcap
    for channel, messages in recorded(smoke_run).items():
        assert [time for time, _ in found[channel]] == [1000 * time for time, _ in messages]
        for (_, told), (_, message) in zip(found[channel], messages, strict=True):
            assert told == {field: plain(getattr(message, field)) for field in message.__slots__}
    assert {topic for topic in found if not topic.startswith("/")} == {
        channel for channel, _ in read_log(smoke_run.messages)
    }


def test_mcap_schemas_have_the_fields_of_the_types(mcap):
    found, schemas = mcap
    for topic in found:
        schema = json.loads(schemas[topic].data)
        if topic in TYPES:
            assert schemas[topic].name == f"limphome.{TYPES[topic].__name__}"
            assert list(schema["properties"]) == TYPES[topic].__slots__
        assert fits(found[topic][0][1], schema)


def fits(value, schema):
    """Whether a value is as a schema of those few kinds wants it."""
    if schema["type"] == "object":
        properties = schema.get("properties", {})
        return set(schema.get("required", [])) <= set(value) and all(fits(value[k], properties[k]) for k in properties)
    if schema["type"] == "array":
        size = schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value))
        return size and all(fits(each, schema["items"]) for each in value)
    kinds = {"integer": int, "number": (int, float), "string": str, "boolean": bool}
    return isinstance(value, kinds[schema["type"]])


def test_frames_of_the_3d_panel_are_those_of_the_robot(smoke_run, mcap):
    found, schemas = mcap
    assert schemas["/tf"].name == "foxglove.FrameTransforms"
    body = robot.read(smoke_run.robot)
    states = recorded(smoke_run)[STATE]
    assert len(found["/tf"]) == len(states)
    (time, told), (_, state) = found["/tf"][777], states[777]
    assert told["transforms"][0]["timestamp"] == {"sec": time // 10**9, "nsec": time % 10**9}
    placed = {"world": np.eye(4)}
    for each in told["transforms"]:
        frame = np.eye(4)
        frame[:3, :3] = rotation_of([each["rotation"][axis] for axis in "wxyz"])
        frame[:3, 3] = [each["translation"][axis] for axis in "xyz"]
        placed[each["child_frame_id"]] = placed[each["parent_frame_id"]] @ frame
    for expected, link in zip(
        body.frames(state.actuator_position[:5], state.position, state.orientation), body.bodies, strict=True
    ):
        assert placed[link["name"]] == pytest.approx(expected, abs=1e-9)


def test_solids_of_the_3d_panel_are_those_of_the_robot_the_failed_crawler_red(smoke_run, mcap):
    found, schemas = mcap
    assert schemas["/robot"].name == "foxglove.SceneUpdate"
    entities = {each["id"]: each for each in found["/robot"][0][1]["entities"]}
    body = robot.read(smoke_run.robot)
    told = [(each["frame_id"], solid) for each in entities.values() for solid in each["cubes"] + each["spheres"]]
    for shape in body.told["shapes"]:
        size = dict(zip("xyz", (2 * half for half in shape["half_size"]), strict=True))
        name = body.bodies[shape["body"]]["name"]
        assert any(frame == name and solid["size"] == pytest.approx(size) for frame, solid in told)
    red, grey = (entities[name]["cubes"][0]["color"] for name in ("left_crawler", "right_crawler"))
    assert red["r"] > 2 * red["g"] and grey["r"] < 1.2 * grey["g"]
    left, right = (entities[name]["cylinders"] for name in ("left_crawler", "right_crawler"))
    assert sorted(each["pose"]["position"]["x"] for each in left) == pytest.approx([-0.62, 0.62])
    assert {each["pose"]["position"]["y"] for each in left + right} == {0.475, -0.475}
    turned = rotation_of([left[0]["pose"]["orientation"][axis] for axis in "wxyz"])
    assert np.abs(turned @ [0, 0, 1]) == pytest.approx([0, 1, 0])  # a cylinder's axis lies across


def test_goal_line_of_the_3d_panel_is_that_of_the_episode(smoke_run, mcap):
    found, _ = mcap
    ends = {message.episode: message for _, message in recorded(smoke_run)[EPISODE]}
    begun = [message.episode for _, message in recorded(smoke_run)[DECISION] if message.step == 0]
    checked = 0
    for number_, (_, told) in zip(begun, found["/goal"], strict=True):
        if number_ not in ends:
            continue
        points = np.array([[point[axis] for axis in "xyz"] for point in told["entities"][0]["lines"][0]["points"]])
        end = ends[number_]
        forward = np.array([np.cos(end.line_heading), np.sin(end.line_heading)])
        left = np.array([-forward[1], forward[0]])
        middle = end.start - end.start_lateral_error * left + end.goal_distance * forward
        assert points.mean(axis=0)[:2] == pytest.approx(middle, abs=1e-4)
        assert (points[0] - points[1])[:2] @ forward == pytest.approx(0, abs=1e-4)
        checked += 1
    assert checked == 30


def test_paths_of_the_3d_panel_hold_each_position(smoke_run, mcap):
    found, _ = mcap
    lengths = [message.steps + 1 for _, message in recorded(smoke_run)[EPISODE]]
    assert [len(told["poses"]) for _, told in found["/path"]] == lengths


def test_tables_have_every_decision_with_its_state(smoke_run, tables):
    messages = recorded(smoke_run)
    states = {(state.session, state.seq): state for _, state in messages[STATE]}
    decisions, _ = tables
    assert len(decisions) == len(messages[DECISION])
    for row, (time, decision) in zip(decisions, messages[DECISION], strict=True):
        assert row["time"] == time / 1e6
        for field in decision.__slots__:
            if field == "inputs":
                assert [row[f"inputs_{k}"] for k in range(decision.num_inputs)] == list(
                    decision.inputs[: decision.num_inputs]
                )
            else:
                assert row[field] == getattr(decision, field)
        state = states[decision.session, decision.seq]
        assert [row[f"position_{axis}"] for axis in "xyz"] == list(state.position)
        assert [row[f"orientation_{axis}"] for axis in "wxyz"] == list(state.orientation)
        for k, name in enumerate(["left_crawler", "right_crawler", "swing", "boom", "arm"]):
            for field in ("position", "velocity", "effort", "health"):
                assert row[f"actuator_{field}_{name}"] == getattr(state, f"actuator_{field}")[k]


def test_tables_have_every_episode_and_each_decision_how_its_episode_ended(smoke_run, tables):
    messages = recorded(smoke_run)
    decisions, episodes = tables
    assert len(episodes) == len(messages[EPISODE]) == 30
    for row, (_, episode) in zip(episodes, messages[EPISODE], strict=True):
        assert row["outcome"] == OUTCOMES[episode.outcome]
        for field in ("episode", "steps", "duration", "reward", "reward_goal", "lateral_error", "line_heading"):
            assert row[field] == getattr(episode, field)
        assert [row["start_x"], row["start_y"]] == list(episode.start)
    ends = {row["episode"]: row for row in episodes}
    for row in decisions:
        end = ends.get(row["episode"])
        assert row["episode_outcome"] == (end["outcome"] if end else None)
        assert row["episode_reward"] == (end["reward"] if end else None)


def copy(run, path, keep=lambda index, channel: True, cut=0):
    """A run folder with some of the events, their numbers kept, and with some bytes less."""
    shutil.copytree(run.path, path, ignore=shutil.ignore_patterns("export", "evaluation"))
    other = RunFolder(path)
    with open(other.messages, "wb") as file:
        for index, (channel, data) in enumerate(read_log(run.messages)):
            if keep(index, channel):
                file.write(HEADER.pack(0xEDA1DA01, index, 0, len(channel), len(data)) + channel.encode() + data)
        file.truncate(file.tell() - cut)
    return other


def test_recording_that_was_cut_off_is_exported_up_to_there(smoke_run, tmp_path):
    torn = copy(smoke_run, tmp_path / "run", cut=3)
    result = run_script("export", torn.path, "--format", "parquet")
    assert "no whole event at byte" in result.stderr and "what lies before is used" in result.stderr
    assert result.stdout.split() == [
        str(torn.path / "export" / f"{name}.parquet") for name in ("decisions", "episodes")
    ]
    assert len(rows(result.stdout.split()[1])) == 30


def test_recording_that_was_thinned_has_all_episodes_and_the_decisions_that_are_left(smoke_run, tmp_path):
    def keep(index, channel):
        return channel == EPISODE or not 1000 < index < 5000

    thinned = copy(smoke_run, tmp_path / "run", keep)
    decisions, episodes = map(rows, export(thinned, "parquet"))
    left = [channel for index, (channel, _) in enumerate(read_log(smoke_run.messages)) if keep(index, channel)]
    assert len(episodes) == 30
    assert len(decisions) == left.count(DECISION) < len(recorded(smoke_run)[DECISION])
    times = [row["time"] for row in episodes]
    assert times == sorted(times)
    found, _ = topics(*export(thinned, "mcap"))
    assert len(found[DECISION]) == len(decisions)


def test_run_without_an_episode_is_refused_and_nothing_left(smoke_run, tmp_path):
    begun = copy(smoke_run, tmp_path / "run", lambda index, channel: index < 20)
    result = run_script("export", begun.path, "--format", "csv", check=False)
    assert result.returncode == 2 and "no episode has ended" in result.stderr
    assert list((begun.path / "export").iterdir()) == []


@pytest.mark.parametrize("form", ["mcap", "parquet", "rosbag2"])
def test_recording_that_holds_nothing_is_refused_and_nothing_left(smoke_run, tmp_path, form):
    empty = copy(smoke_run, tmp_path / "run", lambda index, channel: False)
    result = run_script("export", empty.path, "--format", form, check=False)
    assert result.returncode == 2 and "messages.lcmlog: holds no message of a run" in result.stderr
    assert list((empty.path / "export").iterdir()) == []


def test_numbers_that_json_does_not_know_become_null(tmp_path):
    from limphome_lab.export.json_message import encode

    decision = TYPES[DECISION]()
    decision.q, decision.inputs = float("nan"), [float("inf"), *[0.5] * 17]
    told = json.loads(encode(decision))
    assert told["q"] is None and told["inputs"][:2] == [None, 0.5] and told["q_max"] == 0
