"""What the pages point to is there, the site builds from them without a warning, and needs nothing from elsewhere."""

import os
import re
import subprocess
import sys

import pytest

import limphome
from limphome_lab import paths
from limphome_lab.paths import ROOT

sys.path.insert(0, str(ROOT / "docs" / "site"))
import messages

IGNORED = {".git", ".venv", ".pytest_cache", "build", "runs", "studies"}
PAGES = sorted(
    page for top in ROOT.iterdir() if top.name not in IGNORED for page in (top.rglob("*.md") if top.is_dir() else [top])
)
PAGES = [page for page in PAGES if page.suffix == ".md" and page.parent != ROOT / "docs" / "site"]


def without_code(text):
    return re.sub(r"^```.*?^```|`[^`\n]*`", "", text, flags=re.MULTILINE | re.DOTALL)


def anchors(page):
    """Of its headings, as forges make them."""
    headings = re.findall(
        r"^#+ (.*)$", re.sub(r"^```.*?^```", "", page.read_text(), flags=re.MULTILINE | re.DOTALL), re.M
    )
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page):
    folder = page.parent
    if "site" in folder.parts:
        folder = ROOT / "reference"  # where build.py puts it
    for link in re.findall(r"\]\(([^)\s]+)\)", without_code(page.read_text())):
        path, _, anchor = link.partition("#")
        if "://" in link or path.startswith("mailto:") or (folder / path).parent == ROOT / "reference":
            continue
        target = (folder / path).resolve() if path else page
        assert target.exists(), f"{link}: there is no such file"
        assert not anchor or anchor in anchors(target), f"{link}: there is no such heading"


def test_equations_have_their_functions_and_tests():
    rows = re.findall(r"\[`(lh_\w+)`\]\((.*?)\) \| \[(\w+)\]\((.*?)\)", (ROOT / "docs" / "equations.md").read_text())
    assert len(rows) == 14
    for function, file, test, test_file in rows:
        assert re.search(rf"^[\w ]*\**{function}\(", (ROOT / "docs" / file).read_text(), re.MULTILINE), function
        assert f"START_TEST({test})" in (ROOT / "docs" / test_file).read_text(), test


def test_every_equation_of_the_paper_is_told():
    numbers = set()
    for first, last in re.findall(
        r"^\| \((\d+)\)(?:-\((\d+)\))?", (ROOT / "docs" / "equations.md").read_text(), re.MULTILINE
    ):
        numbers |= set(range(int(first), int(last or first) + 1))
    assert numbers == set(range(1, 22))


def test_page_of_messages_has_every_field():
    types = [each for file in paths.LCMTYPES.glob("*.lcm") for each in messages.read(file.read_text())]
    assert len(types) == len(list(paths.LCMTYPES.glob("*.lcm")))
    for each in types:
        made = getattr(limphome, each.name)
        assert [one.name for one in each.fields] == list(made.__slots__)
        assert {one.name: int(one.kind) for one in each.constants}.items() <= vars(made).items()
        assert each.said and all(one.said for one in each.fields)


def test_citation_is_of_this_version():
    """In the few words of YAML that it has: `key: value`, lists of one level."""
    text = (ROOT / "CITATION.cff").read_text()
    keys = dict(re.findall(r"^([a-z-]+):\s*(.*)$", text, re.MULTILINE))
    version = re.search(r"project\(limphome VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
    assert keys.keys() >= {"cff-version", "message", "title", "authors"}  # what the format requires
    assert keys["version"] == version and keys["license"] == "BSD-3-Clause" and keys["type"] == "software"
    assert re.search(r"^authors:\n  - name: ", text, re.MULTILINE)


def test_site_builds_without_a_warning_or_anything_from_elsewhere(tmp_path):
    environment = {**os.environ, "LIMPHOME_BUILD": str(tmp_path)}
    build = [sys.executable, ROOT / "docs" / "site" / "build.py", tmp_path / "pages"]
    result = subprocess.run(build, env=environment, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    pages = list((tmp_path / "pages").rglob("*.html"))
    assert {"index.html", "search.html", "README.html"} <= {page.name for page in pages}
    assert "lh_controller_step" in (tmp_path / "pages" / "reference" / "c.html").read_text()
    assert "lateral" in (tmp_path / "pages" / "searchindex.js").read_text()
    for page in pages:
        fetched = re.findall(
            r'<(?:script|img|iframe)\b[^>]*\bsrc="(\w+:)?//|<link\b[^>]*\bhref="(\w+:)?//', page.read_text()
        )
        assert not fetched, page
