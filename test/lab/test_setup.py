"""scripts/setup called by sudo: apt alone runs as root, the rest as who called it."""

import os
import subprocess

import pytest

from limphome_lab.paths import ROOT


@pytest.mark.fault(
    "scripts/setup called by sudo",
    injected="SUDO_USER is set, and another program stands in for sudo",
    expected="pip and builds are handed back to that user, with the same arguments",
)
@pytest.mark.skipif(os.geteuid() != 0, reason="root alone can be told to be somebody else")
def test_what_sudo_has_started_goes_on_as_who_called_it(tmp_path, observe):
    sudo = tmp_path / "sudo"
    sudo.write_text('#!/bin/sh\necho "$@"\nexit 7\n')
    sudo.chmod(0o755)
    environment = {**os.environ, "SUDO_USER": "somebody", "PATH": f"{tmp_path}:{os.environ['PATH']}"}
    script = ROOT / "scripts" / "setup"
    result = subprocess.run([script, "a", "b c"], env=environment, capture_output=True, text=True, timeout=300)
    observe(result.stdout.strip().replace(str(ROOT), "."))
    assert result.returncode == 7, result.stderr
    assert result.stdout == f"-u somebody --preserve-env=LIMPHOME_BUILD -- {script} a b c\n"
