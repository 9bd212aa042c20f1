"""Build hook of pyproject.toml: generates the package `limphome` from lcmtypes/ and takes it into the wheel."""

import subprocess
import tempfile
from pathlib import Path

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class GenerateMessages(BuildHookInterface):
    def initialize(self, version, build_data):
        self.folder = tempfile.TemporaryDirectory()
        types = sorted((Path(self.root) / "lcmtypes").glob("*.lcm"))
        subprocess.run(["lcm-gen", "-p", "--ppath", self.folder.name, *types], check=True)
        build_data["force_include"][f"{self.folder.name}/limphome"] = "limphome"

    def finalize(self, version, build_data, artifact_path):
        self.folder.cleanup()
