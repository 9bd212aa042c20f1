"""A browser without a window that draws a page for us: Chromium, which needs neither a display nor a graphics card."""

import os
import shutil
import tempfile
import time
from pathlib import Path

import numpy as np

from limphome_lab.ending import Ending
from limphome_lab.run.processes import Child

NAMES = ("chromium", "chromium-browser", "google-chrome")
OPTIONS = (
    "--headless",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-breakpad",
    "--disable-component-update",
    "--disable-quic",
    "--disable-sync",
    "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
    "--mute-audio",
    # WebGL by the processor
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--window-size=320,240",  # small, as the page draws itself, too; it does not open in one much smaller
)
START_S = 180.0
PICTURE_S = 300.0
END_S = 10.0
SETTLING = 40  # pictures at most until nothing changes any more


def needed(*names):
    """File of the first of these programs; Ending where there is none."""
    found = next(filter(None, map(shutil.which, names)), None)
    if found is None:
        raise Ending(f"{names[0]} is needed and not installed: apt-get install {names[0]}")
    return found


class Browser:
    """Shows a page of view/server.py until the context ends. What its `client` is told comes in order: a picture has
    all that was put into client.scene before, which does not hold for the scene of the page."""

    def __init__(self, page):
        self._page = page
        self._folder = tempfile.TemporaryDirectory(prefix="limphome-", ignore_cleanup_errors=True)
        self._child = None

    def __enter__(self):
        folder = Path(self._folder.name)
        # its sandbox does not work for root, which one also is within a network of a run's own; it opens our page alone
        without = ["--no-sandbox"] if os.geteuid() == 0 else []
        options = [*OPTIONS, *without, f"--user-data-dir={folder / 'profile'}", self._page.url]
        own = ["env", f"HOME={folder}", f"TMPDIR={folder}"]  # it leaves files in both
        self._child = Child("browser", [*own, needed(*NAMES), *options], folder / "log")
        try:
            self.client = self._connected()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        self._child.stop()
        # processes of its own, which end after it, may still put files there
        until = time.monotonic() + END_S
        while Path(self._folder.name).exists() and time.monotonic() < until:
            shutil.rmtree(self._folder.name, ignore_errors=True)
            time.sleep(0.05)
        self._folder.cleanup()

    def _connected(self):
        until = time.monotonic() + START_S
        while time.monotonic() < until and self._child.exit_code() is None:
            for client in self._page.get_clients().values():
                return client
            time.sleep(0.05)
        raise Ending(f"the browser did not open the page:\n{self._child.log_tail()}")

    def picture(self, eye, width, height, field_of_view):
        """[height x width x 3] what is seen from there."""
        try:
            drawn = self.client.get_render(
                height, width, wxyz=eye.wxyz, position=eye.position, fov=field_of_view, timeout=PICTURE_S
            )
        except TimeoutError as error:
            raise Ending(f"the browser draws nothing:\n{self._child.log_tail()}") from error
        return np.ascontiguousarray(drawn[..., :3])

    def settle(self, *view):
        """Waits until what it draws stays as it is: a page that has just been opened appears bit by bit."""
        before = None
        for _ in range(SETTLING):
            now = self.picture(*view)
            if before is not None and np.array_equal(now, before):
                return
            before = now
