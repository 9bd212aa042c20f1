"""On which network a run talks. Every one of these tests stays inside namespaces of its own."""

import os
import subprocess

import pytest

from conftest import ROOT, SMOKE, TIME_LIMIT_S
from limphome_lab import network, registry
from limphome_lab.runfolder import RunFolder

pytestmark = pytest.mark.skipif(network.private_prefix() is None, reason="network namespaces are not permitted here")

NO_NETWORK = (network.private_prefix() or [])[:2]  # unshare and its option: a loopback that is down


def train_inside(prefix, *arguments):
    command = [
        *prefix,
        ROOT / "scripts" / "train",
        "--config",
        SMOKE,
        "--episodes",
        "2",
        "--set",
        "episode.step_limit=10",
        "--quiet",
        *arguments,
    ]
    return subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=TIME_LIMIT_S)


def test_private_network_has_nothing_but_a_loopback():
    script = f"ip -o link; ip route get {network.GROUP}"
    result = subprocess.run([*network.private_prefix(), "sh", "-c", script], capture_output=True, text=True)
    links, route = result.stdout.strip().split("\n", 1)
    assert ": lo:" in links and "MULTICAST" in links
    assert " dev lo " in route


def test_url_keeps_messages_on_this_machine():
    assert "ttl=0" in network.lcm_url()


def test_host_network_is_refused_where_messages_would_leave(tmp_path):
    result = train_inside(NO_NETWORK, "--network", "host", "--out", tmp_path / "run")
    assert result.returncode == 1
    assert network.LOOPBACK_UP in result.stderr
    assert not (tmp_path / "run").exists()


def test_command_that_is_told_makes_the_host_network_good(tmp_path):
    refused = train_inside(NO_NETWORK, "--network", "host", "--out", tmp_path / "run")
    told = refused.stderr.strip().splitlines()[-1].strip()
    again = [*NO_NETWORK, "sh", "-c", f'{told} && exec "$@"', "sh"]
    result = train_inside(again, "--network", "host", "--out", tmp_path / "run")
    assert result.returncode == 0, result.stderr
    assert len(RunFolder(tmp_path / "run").read_episodes()) == 2


@pytest.mark.fault(
    "the host's network has an interface with an address of its own",
    injected="a pair of virtual interfaces, one with 10.9.0.1, before the command that the refusal tells",
    expected="a run with --network host hears itself over the loopback",
)
def test_host_network_beside_another_interface(tmp_path, observe):
    other = "ip link add va type veth peer name vb && ip addr add 10.9.0.1/24 dev va && ip link set va up"
    if subprocess.run([*NO_NETWORK, "sh", "-c", other], capture_output=True).returncode != 0:
        pytest.skip("no virtual interfaces here")
    inside = [*NO_NETWORK, "sh", "-c", f'{other} && {network.LOOPBACK_UP} && exec "$@"', "sh"]
    result = train_inside(inside, "--network", "host", "--out", tmp_path / "run")
    observe(f"exit code {result.returncode}")
    assert result.returncode == 0, result.stderr


def test_host_network_is_used_where_namespaces_are_not_permitted(tmp_path):
    forbidding = tmp_path / "bin" / "unshare"
    forbidding.parent.mkdir()
    forbidding.write_text("#!/bin/sh\nexit 1\n")
    forbidding.chmod(0o755)
    first_in_path = ["env", f"PATH={forbidding.parent}:{os.environ['PATH']}"]
    result = train_inside([*network.private_prefix(), *first_in_path], "--out", tmp_path / "run")
    assert result.returncode == 0, result.stderr
    assert "namespaces are not permitted" in result.stderr


def test_ports_on_the_host_network_differ():
    assert len({network.free_port() for _ in range(20)}) > 1


def test_registry_forgets_processes_that_are_gone(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    entry = registry.register(tmp_path / "run", "udpm://")
    assert [pair["run"] for pair in registry.running()] == [str(tmp_path / "run")]
    # the same process id, taken by another process since
    entry.write_text(entry.read_text().replace('"start": ', '"start": 1'))
    assert registry.running() == []
    assert not entry.exists()
