"""lcm-spy in a window: on a display that a run's network reaches or not, and with every type."""

import contextlib
import os
import shutil
import socket
import subprocess
import threading
from pathlib import Path

import pytest

import limphome
from conftest import ROOT, TIME_LIMIT_S, start_script, wait_until
from limphome_lab.show import spy_window

NEEDED = ("javac", "Xvfb", "xdotool")
pytestmark = pytest.mark.skipif(not all(map(shutil.which, NEEDED)), reason=f"needs {', '.join(NEEDED)}")


@pytest.fixture(params=["file", "abstract", "forwarded"])
def screen(request):
    """Environment of programs that open windows, on a display that is reached in one way: by a socket in the file
    system, by one in the abstract name space, or as `ssh -X` has it, by a port of the loopback. It does not begin anew
    when the last window is closed (-noreset): who connects meanwhile would be turned away."""
    refused = "unix" if request.param == "abstract" else "local"
    server = subprocess.Popen(
        [
            "Xvfb",
            "-displayfd",
            "1",
            "-noreset",
            "-ac",
            "-screen",
            "0",
            "1000x700x24",
            "-nolisten",
            "tcp",
            "-nolisten",
            refused,
        ],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    number = int(server.stdout.readline())
    if request.param == "forwarded":
        listener = socket.create_server(("127.0.0.1", 0))
        threading.Thread(target=forward, args=(listener, f"/tmp/.X11-unix/X{number}"), daemon=True).start()
        yield {**os.environ, "DISPLAY": f"localhost:{listener.getsockname()[1] - 6000}"}
        listener.shutdown(socket.SHUT_RDWR)
    else:
        yield {**os.environ, "DISPLAY": f":{number}"}
    server.terminate()
    server.wait()


def forward(listener, path):
    """Takes the place of sshd: passes on what connections to `listener` send to the socket `path`, and back."""
    with contextlib.suppress(OSError):  # until the listener is shut
        while True:
            near, _ = listener.accept()
            far = socket.socket(socket.AF_UNIX)
            far.connect(path)
            for source, sink in ((near, far), (far, near)):
                threading.Thread(target=copy, args=(source, sink), daemon=True).start()


def copy(source, sink):
    with contextlib.suppress(OSError):
        while data := source.recv(4096):
            sink.sendall(data)
        sink.shutdown(socket.SHUT_WR)


def test_window_shows_the_messages_of_a_channel(launched, screen):
    def xdotool(*words):
        return subprocess.run(["xdotool", *words], env=screen, capture_output=True, text=True).stdout.split()

    def open_first_channel():
        """A double click on the first row of the table opens a window that decodes the channel."""
        xdotool("mousemove", "60", "28", "click", "--repeat", "2", "--delay", "60", "1")
        return xdotool("search", "--name", "^LIMPHOME_")

    spy = start_script("spy", env=screen)
    try:
        wait_until(spy, lambda: xdotool("search", "--name", "^LCM Spy$"))
        wait_until(spy, open_first_channel)
    finally:
        spy.terminate()
        output, errors = spy.communicate(timeout=TIME_LIMIT_S)
    types = len(list((ROOT / "lcmtypes").glob("*.lcm")))
    assert f"Found {types} LCM types" in output + errors


def test_every_type_is_decoded(tmp_path):
    names = [file.stem.removeprefix("limphome_") + "_t" for file in (ROOT / "lcmtypes").glob("*.lcm")]
    for name in names:
        (tmp_path / name).write_bytes(getattr(limphome, name)().encode())
    java = ["java", "-cp", os.pathsep.join([str(spy_window.types_jar()), spy_window.libraries()])]
    decoder = Path(__file__).with_name("Decode.java")
    result = subprocess.run([*java, decoder, *names], cwd=tmp_path, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    assert {f"limphome.{name}" for name in names} <= set(result.stdout.split("\n"))


def test_types_that_have_changed_are_compiled_anew(tmp_path, monkeypatch):
    """Whatever the dates of their files say: those of a package are years old."""
    monkeypatch.setattr(spy_window, "CACHE", tmp_path / "cache")
    monkeypatch.setattr(spy_window.paths, "LCMTYPES", tmp_path)
    type_file = tmp_path / "limphome_one.lcm"
    type_file.write_text("package limphome; struct one_t { int8_t a; }")
    jars = [spy_window.types_jar(), spy_window.types_jar()]
    type_file.write_text("package limphome; struct one_t { int16_t a; }")
    os.utime(type_file, (0, 0))
    jars.append(spy_window.types_jar())
    assert jars[0] == jars[1] != jars[2]
    assert sorted((tmp_path / "cache").iterdir()) == sorted(set(jars))
