"""The network a run talks on.

LCM has no authentication, and two runs on one network would hear each other. So a run gets a network namespace of its
own, with nothing in it but a loopback that carries multicast. Where namespaces are not permitted, or the user asks for
it, a run uses the host's network on a port of its own.
"""

import os
import signal
import socket
import subprocess
import sys

from limphome_lab.ending import Ending

GROUP = "239.255.76.67"
PORT = 7667
RECEIVE_BUFFER = 2 << 20  # [bytes]; the kernel grants up to net.core.rmem_max
# with the loopback's own address: Linux 6 drops what claims to come from one of another interface
LOOPBACK_UP = f"ip link set lo up multicast on && ip route add {GROUP}/32 dev lo src 127.0.0.1"

# Set in a process that is inside a run's network: "private" or the port on the host's.
ENVIRONMENT = "LIMPHOME_NETWORK"


class NetworkError(Ending):
    """No network to run on; the text says what to do."""

    def __init__(self, text):
        super().__init__(f"network: {text}")


def lcm_url(port=PORT):
    """URL for LCM; ttl=0 keeps the messages on this machine."""
    return f"udpm://{GROUP}:{port}?ttl=0&recv_buf_size={RECEIVE_BUFFER}"


def private_prefix():
    """Words to put before a command to run it in a new network namespace, or None where that is not permitted."""
    for unshare in (["unshare", "-rn"], ["unshare", "-n"]):
        prefix = [*unshare, "sh", "-c", f'{LOOPBACK_UP} && exec "$@"', "sh"]
        try:
            if subprocess.run([*prefix, "true"], capture_output=True).returncode == 0:
                return prefix
        except FileNotFoundError:
            continue
    return None


def group_is_on_loopback():
    """Whether the host routes the multicast group to lo, and only there."""
    route = subprocess.run(["ip", "route", "get", GROUP], capture_output=True, text=True)
    return route.returncode == 0 and " dev lo " in route.stdout


def free_port():
    """A UDP port nobody on this machine uses."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("", 0))
        return probe.getsockname()[1]


def host_port():
    """A port on the host's network, or NetworkError where messages would leave the loopback."""
    if not group_is_on_loopback():
        sudo = "" if os.geteuid() == 0 else "sudo "
        raise NetworkError(f"messages would not stay on this machine; run once:\n  {sudo}sh -c '{LOOPBACK_UP}'")
    return free_port()


def enter(wanted="private"):
    """Brings this process into a network for a run and returns the LCM URL to use there.

    For a private network the process replaces itself by a copy of itself inside the new namespace (the process id
    stays), so call it before anything else is under way.
    """
    inside = os.environ.get(ENVIRONMENT)
    if inside == "private":
        return lcm_url()
    if inside:
        return lcm_url(int(inside))
    prefix = private_prefix() if wanted == "private" else None
    if prefix:
        os.environ[ENVIRONMENT] = "private"
        sys.stdout.flush()
        sys.stderr.flush()
        # Ctrl-C waits until with_exit_code of the copy takes it; the shell in between lets all signals through again
        waiting = ["env", "--block-signal=INT"]
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        os.execvp(prefix[0], [*prefix, *waiting, sys.executable, *sys.orig_argv[1:]])
    if wanted == "private":
        print("network: namespaces are not permitted here; using the host's network", file=sys.stderr)
    port = host_port()
    os.environ[ENVIRONMENT] = str(port)
    return lcm_url(port)


def join_prefix(pid):
    """Words to put before a command to run it in the network of process `pid`."""

    def namespace(of, kind):
        return os.readlink(f"/proc/{of}/ns/{kind}")

    if namespace(pid, "net") == namespace("self", "net"):
        return []
    if namespace(pid, "user") == namespace("self", "user"):
        return ["nsenter", "-t", str(pid), "-n"]
    return ["nsenter", "-t", str(pid), "-U", "-n", "--preserve-credentials"]
