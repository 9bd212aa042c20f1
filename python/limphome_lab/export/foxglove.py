"""Foxglove's well-known messages, as JSON, of which its 3D panel makes a picture, and their schemas. They are told by
their names; of their fields those are here that we fill in. Lengths in m, colours and opacity from 0 to 1."""


def _object(**properties):
    return {"type": "object", "properties": properties, "required": list(properties)}


def _array(items):
    return {"type": "array", "items": items}


def _numbers(*names):
    return _object(**{name: {"type": "number"} for name in names})


_TEXT = {"type": "string"}
_TIME = _object(sec={"type": "integer"}, nsec={"type": "integer"})
_POINT = _numbers("x", "y", "z")
_TURN = _numbers("x", "y", "z", "w")
_POSE = _object(position=_POINT, orientation=_TURN)
_COLOUR = _numbers("r", "g", "b", "a")
_SOLID = {"pose": _POSE, "size": _POINT, "color": _COLOUR}
_NUMBER = {"type": "number"}
_LINE = _object(
    type={"type": "integer"},
    pose=_POSE,
    thickness=_NUMBER,
    scale_invariant={"type": "boolean"},
    points=_array(_POINT),
    color=_COLOUR,
    colors=_array(_COLOUR),
    indices=_array({"type": "integer"}),
)
_ENTITY = _object(
    timestamp=_TIME,
    frame_id=_TEXT,
    id=_TEXT,
    lifetime=_TIME,
    frame_locked={"type": "boolean"},
    metadata=_array(_object(key=_TEXT, value=_TEXT)),
    arrows=_array({"type": "object"}),
    cubes=_array(_object(**_SOLID)),
    spheres=_array(_object(**_SOLID)),
    cylinders=_array(_object(**_SOLID, bottom_scale=_NUMBER, top_scale=_NUMBER)),
    lines=_array(_LINE),
    triangles=_array({"type": "object"}),
    texts=_array({"type": "object"}),
    models=_array({"type": "object"}),
)
_TRANSFORM = _object(timestamp=_TIME, parent_frame_id=_TEXT, child_frame_id=_TEXT, translation=_POINT, rotation=_TURN)

SCHEMAS = {
    "foxglove.SceneUpdate": _object(deletions=_array({"type": "object"}), entities=_array(_ENTITY)),
    "foxglove.FrameTransforms": _object(transforms=_array(_TRANSFORM)),
    "foxglove.PosesInFrame": _object(timestamp=_TIME, frame_id=_TEXT, poses=_array(_POSE)),
}


def time(microseconds):
    seconds, rest = divmod(microseconds, 1_000_000)
    return {"sec": seconds, "nsec": rest * 1000}


def point(xyz):
    return dict(zip("xyz", map(float, xyz), strict=True))


def turn(wxyz):
    return dict(zip("wxyz", map(float, wxyz), strict=True))


def pose(position=(0, 0, 0), orientation=(1, 0, 0, 0)):
    return {"position": point(position), "orientation": turn(orientation)}


def colour(web, opacity=1.0):
    """Of #rrggbb."""
    return {name: int(web[at : at + 2], 16) / 255 for name, at in (("r", 1), ("g", 3), ("b", 5))} | {"a": opacity}


def solid(where, size, shade):
    """A cube, or a sphere, of this size along its axes."""
    return {"pose": where, "size": point(size), "color": shade}


def cylinder(where, size, shade):
    """Its axis is z."""
    return {**solid(where, size, shade), "bottom_scale": 1.0, "top_scale": 1.0}


def line(points, thickness, shade):
    """Through all points."""
    return {
        "type": 0,
        "pose": pose(),
        "thickness": thickness,
        "scale_invariant": False,
        "points": [point(each) for each in points],
        "color": shade,
        "colors": [],
        "indices": [],
    }


def entity(when, frame, name, **primitives):
    """What moves along with `frame`, in place of an earlier one of this name."""
    kinds = ("arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models")
    return {
        "timestamp": when,
        "frame_id": frame,
        "id": name,
        "lifetime": time(0),
        "frame_locked": True,
        "metadata": [],
        **{kind: primitives.get(kind, []) for kind in kinds},
    }


def transform(when, parent, child, position, orientation):
    return {
        "timestamp": when,
        "parent_frame_id": parent,
        "child_frame_id": child,
        "translation": point(position),
        "rotation": turn(orientation),
    }
