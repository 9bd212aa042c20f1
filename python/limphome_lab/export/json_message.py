"""Our messages as JSON, and the JSON Schema of each type: an object with the fields of the .lcm file."""

import json
import math


def encode(message):
    """Bytes; what is not finite, which JSON does not know, becomes null."""
    told = {field: getattr(message, field) for field in type(message).__slots__}
    try:
        text = json.dumps(told, allow_nan=False, default=_nested)
    except ValueError:
        text = json.dumps(_finite(told))
    return text.encode()


def _nested(message):
    return {field: getattr(message, field) for field in type(message).__slots__}


def _finite(value):
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, (list, tuple)):
        return [_finite(entry) for entry in value]
    if isinstance(value, dict):
        return {name: _finite(entry) for name, entry in value.items()}
    return value if isinstance(value, int) else _finite(_nested(value))


def schema(kind):
    """JSON Schema of a message type. A new message tells by its values what each field holds, and how many."""
    return {"title": f"limphome.{kind.__name__}", **_schema(kind())}


def _schema(value):
    if isinstance(value, int):
        return {"type": "integer"}
    if isinstance(value, float):
        return {"type": "number"}
    if isinstance(value, list):
        return {"type": "array", "items": _schema(value[0]), "minItems": len(value), "maxItems": len(value)}
    fields = {field: _schema(getattr(value, field)) for field in type(value).__slots__}
    return {"type": "object", "properties": fields, "required": list(fields)}
