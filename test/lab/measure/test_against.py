"""scripts/bench --against: what got worse is named, what is no such file is refused before anything is measured."""

import json
import subprocess
import sys

import pytest

from limphome_lab.ending import InputError
from limphome_lab.measure import against


def write(tmp_path, content):
    file = tmp_path / "bench.json"
    file.write_text(content if isinstance(content, str) else json.dumps(content))
    return file


def test_reads_what_bench_writes(tmp_path):
    figure = {"name": "decision", "value": 2e-6, "unit": "s", "baseline": 3e-5, "ratio": 15.0}
    assert against.read(write(tmp_path, [figure])) == {"decision": 15.0}


def test_names_what_fell_beyond_the_tolerance():
    before = {"a": 10.0, "b": 10.0, "c": 10.0, "gone": 2.0}
    now = {"a": 7.9, "b": 8.1, "c": 20.0, "fresh": 1.0}
    lines, worse = against.compare(before, now)
    assert worse == ["a"]
    text = {line.split()[0]: line for line in lines}
    assert "-21 %" in text["a"] and "WORSE" in text["a"]
    assert "WORSE" not in text["b"] + text["c"] + text["fresh"] + text["gone"]
    assert "new" in text["fresh"] and "not measured" in text["gone"]


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("{", "not what scripts/bench --json writes"),
        ("{}", "holds no figure"),
        ([], "holds no figure"),
        ([1], "name and ratio"),
        ([{"name": "a"}], "name and ratio"),
        ([{"name": "a", "ratio": "fast"}], "ratio of a is 'fast'"),
        ([{"name": "a", "ratio": 0}], "must be a number above 0"),
        ([{"name": "a", "ratio": True}], "must be a number above 0"),
        ([{"name": "a", "ratio": 10**400}], "ratio of a is inf"),
        ([{"name": None, "ratio": 1}], "name None: must be a text"),
        ([{"name": 1, "ratio": 1}], "name 1.0: must be a text"),
        ("[" * 100_000, "not what scripts/bench --json writes"),
        ('[{"name": "a", "ratio": NaN}]', "ratio of a is nan"),
    ],
)
def test_bad_file_is_named_with_what_is_wrong(tmp_path, content, told):
    file = write(tmp_path, content)
    with pytest.raises(InputError) as error:
        against.read(file)
    assert str(error.value).startswith(f"{file}: ") and told in str(error.value)


def test_missing_file_is_told_before_anything_is_measured(tmp_path):
    command = [sys.executable, "-m", "limphome_lab.measure.bench", "--against", tmp_path / "none.json"]
    result = subprocess.run(command, capture_output=True, text=True, timeout=20)
    assert result.returncode == 2
    assert result.stderr == f"{tmp_path}/none.json: No such file or directory\n"
