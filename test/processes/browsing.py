"""A browser in which the tests open pages."""

import os
import re
import shutil
import time

import pytest

SLOW_MS = 120_000  # a browser that draws without a graphics card takes its time
ARGUMENTS = [  # drawing by the processor, and nothing that talks to the outside
    *("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
]


def browser():
    """Chromium without a window; the fixture of that name."""
    program = shutil.which("chromium")
    if program is None:
        pytest.skip("chromium is not installed; scripts/test does it")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        root = ["--no-sandbox"] if os.geteuid() == 0 else []
        browser = playwright.chromium.launch(executable_path=program, args=[*ARGUMENTS, *root])
        yield browser
        browser.close()


class Page:
    def __init__(self, browser, address):
        self.foreign = []  # requests to elsewhere
        self.page = browser.new_page(viewport={"width": 760, "height": 420})
        self.page.set_default_timeout(SLOW_MS)
        self.page.on("request", lambda request: self._look(request.url, address))
        self.page.goto(address)

    def _look(self, url, address):
        if not url.startswith((address, f"blob:{address[: address.index('/', 8)]}", "data:")):
            self.foreign.append(url)

    def find(self, pattern):
        """Groups of a pattern in the page's text, once it is there."""
        deadline = time.monotonic() + SLOW_MS / 1000
        while not (found := re.search(pattern, self.page.inner_text("body"))):
            assert time.monotonic() < deadline, f"{pattern} is not in:\n{self.page.inner_text('body')}"
            time.sleep(0.1)
        return found.groups()

    def press(self, label):
        self.page.get_by_text(label).first.dispatch_event("click")

    def picture(self):
        return self.page.locator("canvas").first.screenshot(timeout=SLOW_MS, animations="allow")
