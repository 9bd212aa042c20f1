"""A recording as a bag of ROS 2, read back by a reader of bags."""

import numpy as np
from rosbags.highlevel import AnyReader

from conftest import train
from limphome_lab.channels import STATE
from limphome_lab.export import rosbag2
from limphome_lab.messages import recorded
from limphome_lab.robot import read, rotation_of
from limphome_lab.runfolder import RunFolder


def test_bag_tells_each_state_once_at_a_time_that_never_runs_back(tmp_path):
    train(tmp_path / "run", "--episodes", 2, "--set", "episode.reset_every=1")
    run = RunFolder(tmp_path / "run")
    bag, again = (rosbag2.write(run, tmp_path)[0] for _ in range(2))
    assert bag == again == tmp_path / "rosbag2"
    assert sorted(file.name for file in bag.iterdir()) == ["metadata.yaml", "rosbag2.db3"]
    states = {(state.session, state.seq): state for _, state in recorded(run.messages, STATE)}
    robot = read(run.robot)
    with AnyReader([bag], default_typestore=rosbag2.ROS) as reader:
        assert {each.topic: each.msgcount for each in reader.connections} == dict.fromkeys(rosbag2.TOPICS, len(states))
        messages = {topic: [] for topic in rosbag2.TOPICS}
        times = []
        for connection, time, raw in reader.messages():
            messages[connection.topic].append(reader.deserialize(raw, connection.msgtype))
            times.append(time)
    assert times == sorted(times) and times[-1] > 0
    for state, joints, pose, frames in zip(states.values(), *messages.values(), strict=True):
        assert joints.name == robot.actuators
        assert tuple(joints.position) == state.actuator_position[: state.num_actuators]
        at = pose.pose.position
        assert (at.x, at.y, at.z) == state.position
        assert joints.header.stamp == pose.header.stamp == frames.transforms[0].header.stamp
    # the chain of frames ends where the robot's own does
    place = np.eye(4)
    last = {each.child_frame_id: each for each in frames.transforms}
    chain, name = [], robot.bodies[-1]["name"]
    while name != "world":
        chain.append(last[name].transform)
        name = last[name].header.frame_id
    for moved in reversed(chain):
        step = np.eye(4)
        turn = moved.rotation
        step[:3, :3] = rotation_of([turn.w, turn.x, turn.y, turn.z])
        step[:3, 3] = moved.translation.x, moved.translation.y, moved.translation.z
        place = place @ step
    angles = state.actuator_position[: len(robot.actuators)]
    assert np.allclose(place, robot.frames(angles, state.position, state.orientation)[-1])
