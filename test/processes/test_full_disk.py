"""A full disk is told, and after there is room again the run goes on as if nothing had been."""

import os
import subprocess

import pytest

from conftest import ROOT, SMOKE, TIME_LIMIT_S, train
from limphome_lab.channels import EPISODE
from limphome_lab.messages import recorded
from limphome_lab.runfolder import RunFolder

SHORT = ["--episodes", "60", "--set", "episode.step_limit=20", "--set", "episode.reset_every=10"]
# A disk of a size of its own, in a mount namespace that ends with the shell; then more room, and the run is gone on
# with and copied to where it can be looked at.
SCRIPT = r"""
mount -t tmpfs -o size="$1"k tmpfs "$2" && shift
disk=$1; whole=$2; shift 2
"$TRAIN" --quiet --no-figures --config "$SMOKE" --out "$disk/run" "$@"
echo "first: $?" >&2
mount -o remount,size=64m "$disk"
if [ -e "$disk/run/manifest.json" ]; then
    "$TRAIN" --quiet --no-figures --resume "$disk/run"
else
    rm -rf "$disk/run"
    "$TRAIN" --quiet --no-figures --config "$SMOKE" --out "$disk/run" "$@"
fi
echo "second: $?" >&2
cp -r "$disk/run" "$whole"
"""


def has_mount_namespaces():
    probe = "mount -t tmpfs tmpfs /tmp"
    return subprocess.run(["unshare", "-rm", "sh", "-c", probe], capture_output=True).returncode == 0


@pytest.fixture(scope="module")
def unbroken(tmp_path_factory):
    folder = RunFolder(tmp_path_factory.mktemp("unbroken") / "run")
    train(folder.path, "--no-figures", *SHORT)
    return folder


@pytest.mark.skipif(not has_mount_namespaces(), reason="no mount namespaces here")
@pytest.mark.fault(
    "the disk is full",
    injected="a tmpfs of that many KiB, enlarged afterwards",
    expected="'No space left', exit code 1; with --resume the run ends as an unbroken one",
)
@pytest.mark.parametrize("size", [4, 16, 32, 64, 200, 400])
def test_full_disk(unbroken, tmp_path, observe, size):
    disk, whole = tmp_path / "disk", tmp_path / "whole"
    disk.mkdir()
    command = ["unshare", "-rm", "sh", "-c", SCRIPT, "sh", str(size), str(disk), str(whole), *SHORT]
    environment = {"TRAIN": str(ROOT / "scripts" / "train"), "SMOKE": str(SMOKE)}
    result = subprocess.run(command, capture_output=True, text=True, timeout=TIME_LIMIT_S, env=os.environ | environment)
    first, second = result.stderr.split("first: ")
    assert "no space left" in first.lower() and "Traceback" not in result.stderr, result.stderr
    assert second.startswith("1" if size > 8 else "2"), result.stderr
    assert "second: 0" in second, result.stderr
    folder = RunFolder(whole)
    assert folder.episodes.read_bytes() == unbroken.episodes.read_bytes()
    assert folder.policy.read_bytes() == unbroken.policy.read_bytes()
    assert [episode.episode for _, episode in recorded(folder.messages, EPISODE)] == list(range(1, 61))
    observe(first.strip().splitlines()[-1].replace(str(disk), "DISK"))
