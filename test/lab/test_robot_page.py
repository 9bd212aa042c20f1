"""docs/robot.md has every text that the reader of robot files can say, and all attributes of <limphome>."""

import re

from limphome_lab.paths import ROOT

PAGE = (ROOT / "docs" / "robot.md").read_text()
SOURCES = sorted((ROOT / "robot").glob("*.c"))
LITERALS = re.compile(r'"(?:[^"\\]|\\.)*"(?:\s*"(?:[^"\\]|\\.)*")*')


def messages():
    """Texts of more than a word, with … for what is filled in."""
    for source in SOURCES:
        code = re.sub(r"/\*.*?\*/", "", source.read_text(), flags=re.DOTALL)
        for literal in LITERALS.findall(code):
            text = "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', literal)).replace('\\"', '"')
            text = re.sub(r"%[-+ 0-9.*]*l*[a-z]", "…", text)
            text = text.replace("\\n", "").strip()
            if re.search(r"[A-Za-z>][:;,]? [a-z<…]", text) and text != "out of memory":
                yield text


def test_every_message_is_explained():
    said = set(messages())
    assert len(said) > 80
    missing = sorted(text for text in said if text not in PAGE)
    assert not missing, "\n".join(missing)


def test_no_message_is_explained_that_nothing_says():
    tables = PAGE.partition("## Every message")[2]
    rows = [line.split(" | ")[0] for line in tables.splitlines() if line.startswith("| `")]
    told = {text for row in rows for text in re.findall(r"`([^`]+)`", row)}
    assert told and told <= set(messages()), sorted(told - set(messages()))


def test_every_attribute_of_the_extension_is_told():
    code = (ROOT / "robot" / "extension.c").read_text()
    lists = re.findall(r"\*const (?:known|own|hold|no_contact|names)\[\]\s*=\s*\{([^}]*)\}", code)
    names = {name for words in lists for name in re.findall(r'"(\w+)"', words)}
    assert {"crawler", "joint", "self_contact"} <= names
    elements = PAGE.partition("## Elements of `<limphome>`")[2].partition("\n## ")[0]
    assert {name for name in names if not re.search(rf"[`<\[]{name}\b", elements)} == set()
