"""limphome-pair, controller and simulator in one process: the files of two processes, whatever happens to either."""

import json
import os
import random
import signal
import socket
import struct
import subprocess
import time
from pathlib import Path

import pytest
from bus import COMMON, Program, inside, settings

from conftest import ROOT, SMOKE, TIME_LIMIT_S, geared_robot, processes_that_mention, run_script, start_script, train
from limphome_lab import network, paths
from limphome_lab.channels import STATUS
from limphome_lab.messages import TYPES, recorded
from limphome_lab.runfolder import RunFolder

SHORT = settings("learning.episodes=12", "episode.step_limit=60", "episode.reset_every=5")
LONGER = settings("learning.episodes=40", "episode.step_limit=60", "episode.reset_every=5")  # to be interrupted
# random per life, or told by a clock on the wall
OF_ITS_OWN = ("session", "sender", "reset_sender", "reset_nonce", "nonce", "challenge", "sent")
BY_THE_CLOCK = ("velocity_command_t", "reset_request_t")  # whose utime is not the plant's


def pair(config, out, *more):
    robot = ROOT / "config" / "crawler.urdf"
    return [paths.program("pair"), "--config", config, "--robot", robot, "--out", out, *more]


def run_pair(config, out, *more):
    words = [*map(str, pair(config, out, *more))]
    return subprocess.run(words, capture_output=True, text=True, timeout=TIME_LIMIT_S)


class LossyRelay:
    """Carries datagrams between two ports of the group and mistreats some of them."""

    def __init__(self, *ports, seed=1):
        self.dice = random.Random(seed)
        self.ports = ports
        self.sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
        self.sender.bind(("", 0))
        self.receivers = [self._receiver(port) for port in ports]
        self.lost = self.repeated = 0

    @staticmethod
    def _receiver(port):
        receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        receiver.bind((network.GROUP, port))
        group = struct.pack("4s4s", socket.inet_aton(network.GROUP), socket.inet_aton("127.0.0.1"))
        receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)
        receiver.setblocking(False)
        return receiver

    def carry(self):
        """What is there now, each way."""
        for receiver, port in zip(self.receivers, reversed(self.ports), strict=True):
            try:
                while True:
                    datagram, (_, source) = receiver.recvfrom(65536)
                    if source != self.sender.getsockname()[1]:
                        self._mistreat(datagram, (network.GROUP, port))
            except BlockingIOError:
                continue

    def _mistreat(self, datagram, to):
        times = self.dice.choices((0, 1, 2), (0.2, 0.6, 0.2))[0]
        self.lost += times == 0
        self.repeated += times == 2
        for _ in range(times):
            self.sender.sendto(datagram, to)


def learn_over_a_lossy_link(config, folder):
    """By two processes in a network of their own; (exit code, datagrams lost, repeated)."""
    relay = LossyRelay(network.PORT, network.PORT + 1)
    common = ["--config", config, *COMMON[2:4], *SHORT]
    plant = Program([paths.program("simulator"), *common, "--lcm-url", network.lcm_url()], f"{folder}-plant.log")
    learner = [paths.program("controller"), *common, "--out", folder, "--lcm-url", network.lcm_url(network.PORT + 1)]
    controller = Program(learner, f"{folder}-controller.log")
    deadline = time.monotonic() + TIME_LIMIT_S
    while controller.running() and time.monotonic() < deadline:
        relay.carry()
        time.sleep(0.0001)
    plant.end()
    return controller.end(), relay.lost, relay.repeated


def learned(folder):
    """The bytes of all that was learned, by file."""
    files = [folder.episodes, folder.policy, *folder.checkpoint_files()]
    return {file.name: file.read_bytes() for file in files}


def told(folder):
    """What the recording tells but for the status of each second, without what is of a run's own."""
    for channel in TYPES:
        for at, message in recorded(folder.messages, channel) if channel != STATUS else ():
            own = OF_ITS_OWN + (("utime",) if type(message).__name__ in BY_THE_CLOCK else ())
            for field in own:
                if hasattr(message, field):
                    setattr(message, field, 0)
            yield channel, at, message.encode()


@pytest.mark.fault(
    "a link that mistreats messages between two processes, and none",
    injected="a fifth of the datagrams lost and a fifth repeated between simulator and controller; the same run as one "
    "process",
    expected="table, policy and checkpoints are the same bytes, and so is what was recorded but for clocks and random "
    "numbers",
)
@pytest.mark.parametrize("experiment", ["paper", "default"])
def test_same_bytes_as_two_processes(tmp_path, experiment, observe):
    config = ROOT / "config" / f"{experiment}.ini"
    two, one = RunFolder(tmp_path / "two"), RunFolder(tmp_path / "one")
    code, lost, repeated = inside(learn_over_a_lossy_link, str(config), str(two.path))
    assert code == 0
    assert lost > 50 < repeated
    result = run_pair(config, one.path, *SHORT)
    assert result.returncode == 0, result.stderr
    assert learned(one) == learned(two)
    assert len(learned(one)) == 5
    assert list(told(one)) == list(told(two))
    observe(f"{lost} datagrams lost, {repeated} repeated; the same bytes")


@pytest.fixture(scope="module")
def unbroken(tmp_path_factory):
    folder = RunFolder(tmp_path_factory.mktemp("unbroken") / "run")
    assert run_pair(SMOKE, folder.path, *LONGER).returncode == 0
    return folder


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_ended_by_a_signal_and_gone_on_with(tmp_path, unbroken, number):
    folder = RunFolder(tmp_path / "run")
    program = Program(pair(SMOKE, folder.path, *LONGER), tmp_path / "log")
    while len(folder.read_episodes()) < 12:
        assert program.running(), program.words()
        time.sleep(0.01)
    program.signal(number)
    assert program.process.wait(TIME_LIMIT_S) == 130
    assert "stopped after episode" in program.words()
    assert 12 <= len(folder.read_episodes()) < 40
    assert folder.policy.exists(), "what was learned is kept"
    assert run_pair(SMOKE, folder.path, *LONGER, "--resume").returncode == 0
    assert learned(folder) == learned(unbroken)


def test_evaluates(tmp_path, unbroken):
    out = RunFolder(tmp_path / "out")
    more = ["--evaluate", unbroken.policy, *LONGER, *settings("learning.episodes=2")]
    assert run_pair(SMOKE, out.path, *more).returncode == 0
    assert [episode.episode for episode in out.read_episodes()] == [41, 42]


def test_real_time_is_refused(tmp_path):
    result = run_pair(SMOKE, tmp_path / "run", *settings("simulator.pace=real_time"))
    assert result.returncode == 2
    assert "[simulator] pace = real_time" in result.stderr
    assert not (tmp_path / "run").exists()


def test_bad_input_starts_nothing(tmp_path):
    assert run_pair(SMOKE, tmp_path / "run", "--lcm-url", "memq://").returncode == 2
    joint = run_pair(SMOKE, tmp_path / "run", *settings("failure.actuator=joint_5"))
    assert joint.returncode == 2
    assert "[failure] actuator = joint_5" in joint.stderr
    assert not (tmp_path / "run").exists()


@pytest.mark.fault(
    "a simulation that diverges again and again, in one process with its controller",
    injected="a robot geared beyond reason",
    expected="the process says so and ends by exit code 1; the run folder is whole",
)
def test_plant_that_gives_up_ends_the_run(tmp_path, observe):
    robot = geared_robot(tmp_path)
    more = ["--robot", robot, *settings("failure.actuator=none")]
    result = run_pair(SMOKE, tmp_path / "run", *more)
    assert result.returncode == 1
    assert "it did so in 10 sessions in a row; giving up" in result.stderr
    assert RunFolder(tmp_path / "run").policy.exists()
    observe(result.stderr.splitlines()[-1])


def test_train_in_one_process(tmp_path, smoke_run):
    folder = RunFolder(tmp_path / "run")
    train(folder.path, "--one-process", "--no-figures")
    assert learned(folder) == learned(smoke_run)
    manifest = json.loads(folder.manifest.read_text())
    assert manifest["programs"] == ["pair"]
    assert list(manifest["digests"]) == ["robot", "pair"]
    assert manifest["link_share"] == 0
    assert manifest["simulator_share"] + manifest["controller_share"] == pytest.approx(1, abs=1e-3)
    assert manifest["decisions"] >= sum(episode.steps for episode in folder.read_episodes())


@pytest.mark.fault(
    "a run in one process dies in the middle",
    injected="SIGKILL; train --one-process --supervise",
    expected="it is started again, and the run ends byte for byte as an unbroken one",
)
def test_supervised_in_one_process(tmp_path, unbroken, observe):
    folder = RunFolder(tmp_path / "run")
    words = ["--config", SMOKE, "--out", folder.path, *LONGER, "--one-process", "--supervise", "--no-figures"]
    process = start_script("train", *words, "--quiet")
    while len(folder.read_episodes()) < 12:
        assert process.poll() is None, process.communicate()[1]
        time.sleep(0.01)
    for pid in processes_that_mention(folder.path):
        if "limphome-pair" in Path(f"/proc/{pid}/comm").read_text():
            os.kill(pid, signal.SIGKILL)
    assert process.wait(TIME_LIMIT_S) == 0, process.communicate()[1]
    assert learned(folder) == learned(unbroken)
    restarts = json.loads(folder.manifest.read_text())["parts"][0]["restarts"]
    assert [restart["process"] for restart in restarts] == ["pair"]
    observe(f"{restarts[0]['ended']} after episode {restarts[0]['after_episode']}, same table and policy")


@pytest.mark.parametrize("more", [["--view"], ["--network", "host"]])
def test_what_needs_a_network_is_refused(tmp_path, more):
    result = run_script("train", "--one-process", *more, "--out", tmp_path / "run", check=False)
    assert result.returncode == 2
    assert more[0] in result.stderr
    assert not (tmp_path / "run").exists()
