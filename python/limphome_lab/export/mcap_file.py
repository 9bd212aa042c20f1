"""A recording as MCAP: our messages as JSON on topics named as their channels, and what a 3D panel shows."""

import json

from mcap.writer import Writer

from limphome_lab import files
from limphome_lab.channels import DECISION, EPISODE, STATE
from limphome_lab.export import foxglove, json_message
from limphome_lab.export.scene import Scene, goal_line, path
from limphome_lab.messages import TYPES
from limphome_lab.robot import read
from limphome_lab.show.share import Share
from limphome_lab.timeline import timeline

TOPICS = {  # of the picture
    "/robot": "foxglove.SceneUpdate",
    "/goal": "foxglove.SceneUpdate",
    "/tf": "foxglove.FrameTransforms",
    "/path": "foxglove.PosesInFrame",
}


def write(folder, out):
    """The recording of a run into the folder `out`; returns the file."""
    file = out / "messages.mcap"
    scene = Scene(read(folder.robot))
    log = folder.messages
    with files.replacing(file) as fresh, open(fresh, "wb") as stream, Share("exporting", log.stat().st_size) as share:
        writer = Writer(stream)
        writer.start(profile="", library="limphome")
        topics, picture = Topics(writer), Picture(scene)
        for time, channel, message in timeline(log, share.update):
            topics.add(time, channel, json_message.encode(message))
            for topic, drawn in picture.of(time, channel, message):
                topics.add(time, topic, json.dumps(drawn).encode())
        writer.finish()
    return [file]


class Topics:
    """Channels of the file, made when they are first used; time in microseconds."""

    def __init__(self, writer):
        self._writer = writer
        self._channels = {}
        self._schemas = {}

    def add(self, time, topic, data):
        if topic not in self._channels:
            schema = self._schema(topic)
            self._channels[topic] = self._writer.register_channel(topic, message_encoding="json", schema_id=schema)
        self._writer.add_message(self._channels[topic], log_time=time * 1000, publish_time=time * 1000, data=data)

    def _schema(self, topic):
        if topic in TOPICS:
            name, schema = TOPICS[topic], foxglove.SCHEMAS[TOPICS[topic]]
        else:
            schema = json_message.schema(TYPES[topic])
            name = schema["title"]
        if name not in self._schemas:
            data = json.dumps(schema).encode()
            self._schemas[name] = self._writer.register_schema(name, encoding="jsonschema", data=data)
        return self._schemas[name]


class Picture:
    """What changes in a picture with each message."""

    def __init__(self, scene):
        self._scene = scene
        self._drawn = None  # session and health for which the solids are drawn
        self._states = []  # since the last episode

    def of(self, time, channel, message):
        """Yields (topic, message)."""
        if channel == STATE:
            shown = (message.session, tuple(message.actuator_health))
            if shown != self._drawn:
                self._drawn = shown
                yield "/robot", self._scene.solids(time, message)
            yield "/tf", self._scene.frames(time, message)
            self._states.append(message)
        elif channel == DECISION and message.step == 0 and self._states:
            yield "/goal", goal_line(time, message, self._states[-1])
        elif channel == EPISODE:
            yield "/path", path(time, [state for state in self._states if state.session == message.session])
            self._states = self._states[-1:]  # where one ends, the next may begin
