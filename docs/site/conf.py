"""Sphinx's settings. build.py calls it on a folder of links to the tree; warnings are errors."""

import os
from pathlib import Path

BUILT = Path(os.environ["LIMPHOME_SITE"])  # what build.py has made

project = "limphome"
copyright = "2026, the limphome authors"
html_title = "limphome"
root_doc = "index"
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
exclude_patterns = ["docs/site/**", "docs/results_*.md"]  # the latter are parts of results.md

myst_heading_anchors = 4
suppress_warnings = ["myst.header"]  # a page may begin below the first level

breathe_projects = {"limphome": str(BUILT / "doxygen" / "xml")}
breathe_default_project = "limphome"
breathe_domain_by_extension = {"h": "c"}
breathe_show_include = False

default_role = "code"  # `names` in docstrings
autodoc_member_order = "bysource"
autodoc_typehints = "description"

html_theme = "furo"
html_static_path = []
html_show_sphinx = False
html_copy_source = False
