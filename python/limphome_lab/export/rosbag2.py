"""A recording as a bag of ROS 2, without ROS: joints, pose and frames of the robot at each state.

`ros2 bag play` plays it, RViz, PlotJuggler and Foxglove open it. Time of bag and stamps is the plant's, laid along one
line (timeline.py): begin with `--clock` and use_sim_time.
"""

import shutil

import numpy as np
from rosbags.rosbag2 import Writer
from rosbags.typesys import Stores, get_typestore

from limphome_lab.channels import STATE
from limphome_lab.export.scene import WORLD, Scene
from limphome_lab.robot import read
from limphome_lab.show.share import Share
from limphome_lab.timeline import timeline

VERSION = 9  # of the format: from ROS 2 Iron on
ROS = get_typestore(Stores.ROS2_JAZZY)
TOPICS = {
    "/joint_states": "sensor_msgs/msg/JointState",
    "/pose": "geometry_msgs/msg/PoseStamped",
    "/tf": "tf2_msgs/msg/TFMessage",
}


def write(folder, out):
    """The recording of a run as the bag rosbag2/ in the folder `out`, in place of an earlier one; returns it."""
    bag, fresh = out / "rosbag2", out / "rosbag2.new"
    shutil.rmtree(fresh, ignore_errors=True)
    fresh.mkdir(parents=True)
    scene = Scene(read(folder.robot))
    log = folder.messages
    try:
        _record(log, scene, fresh / bag.name)
        shutil.rmtree(bag, ignore_errors=True)
        (fresh / bag.name).rename(bag)
    finally:
        shutil.rmtree(fresh, ignore_errors=True)
    return [bag]


def _record(log, scene, bag):
    with Writer(bag, version=VERSION) as writer, Share("exporting", log.stat().st_size) as share:
        connections = {topic: writer.add_connection(topic, kind, typestore=ROS) for topic, kind in TOPICS.items()}
        last = None
        for time, channel, state in timeline(log, share.update):
            if channel == STATE and (state.session, state.seq) != last:  # a plant repeats what is not answered
                last = state.session, state.seq
                for topic, message in told(scene, time, state).items():
                    data = ROS.serialize_cdr(message, TOPICS[topic])
                    writer.write(connections[topic], time * 1000, data)


def told(scene, time, state):
    """{topic: message} of one state."""
    head = _header(time, WORLD)
    count = state.num_actuators
    joints = _make(
        "sensor_msgs/msg/JointState",
        header=head,
        name=scene.robot.actuators,
        position=np.array(state.actuator_position[:count]),  # of a crawler's belt [m]
        velocity=np.array(state.actuator_velocity[:count]),
        effort=np.array(state.actuator_effort[:count]),
    )
    w, *xyz = state.orientation
    pose = _make("geometry_msgs/msg/Pose", position=_point(*state.position), orientation=_turn(*xyz, w))
    frames = [_frame(time, **frame) for frame in scene.frames(time, state)["transforms"]]
    return {
        "/joint_states": joints,
        "/pose": _make("geometry_msgs/msg/PoseStamped", header=head, pose=pose),
        "/tf": _make("tf2_msgs/msg/TFMessage", transforms=frames),
    }


def _frame(time, parent_frame_id, child_frame_id, translation, rotation, **_):
    moved = _make("geometry_msgs/msg/Vector3", **translation)
    transform = _make("geometry_msgs/msg/Transform", translation=moved, rotation=_turn(**rotation))
    return _make(
        "geometry_msgs/msg/TransformStamped",
        header=_header(time, parent_frame_id),
        child_frame_id=child_frame_id,
        transform=transform,
    )


def _header(time, frame):
    seconds, rest = divmod(time, 1_000_000)
    stamp = _make("builtin_interfaces/msg/Time", sec=seconds, nanosec=rest * 1000)
    return _make("std_msgs/msg/Header", stamp=stamp, frame_id=frame)


def _point(x, y, z):
    return _make("geometry_msgs/msg/Point", x=x, y=y, z=z)


def _turn(x, y, z, w):
    return _make("geometry_msgs/msg/Quaternion", x=x, y=y, z=z, w=w)


def _make(kind, **fields):
    return ROS.types[kind](**fields)
