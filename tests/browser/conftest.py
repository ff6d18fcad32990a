"""A real Chromium, and the pages it is shown."""

import contextlib
import os
import shutil
import subprocess
from pathlib import Path

import pytest
from playwright.sync_api import sync_playwright

from grammarbt.cli import main

ROOMS = Path(__file__).parents[1] / "report" / "rooms.py"
SWEEPING = "?( →( (dirty) [sweep] ) →( !(dirty) [move] ) )"
NAMES = ("chromium", "chromium-browser", "google-chrome")
INSTALL = (["apt-get", "update", "-qq"], ["apt-get", "install", "-y", "-qq", "--no-install-recommends", "chromium"])


def find_chromium():
    return next(filter(None, map(shutil.which, NAMES)), None)


def install_chromium():
    """Debian's, where continuous integration runs as root; elsewhere that is the user's to decide."""
    if os.environ.get("CI") and os.geteuid() == 0 and shutil.which("apt-get"):
        for command in INSTALL:
            with contextlib.suppress(subprocess.TimeoutExpired):  # no network
                subprocess.run(command, check=False, capture_output=True, timeout=180)
    return find_chromium()


@pytest.fixture(scope="session")
def chromium_path():
    """Where the browser is, looked for once; None if there is none."""
    return find_chromium() or install_chromium()


@pytest.fixture(scope="module")
def chromium(chromium_path):
    """A running browser, closed before other tests: while Playwright is there, nobody else can run an event loop."""
    if chromium_path is None:
        pytest.skip("no Chromium is installed; with Debian: apt-get install chromium")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=chromium_path, args=["--no-sandbox", "--disable-dev-shm-usage"]
        )
        yield browser
        browser.close()


@pytest.fixture
def show(chromium):
    """Opens a file and gives its page, which must load nothing, log nothing and raise nothing."""
    seen, contexts = [], []

    def call(path, scheme="light"):
        contexts.append(chromium.new_context(color_scheme=scheme, viewport={"width": 1280, "height": 800}))
        page = contexts[-1].new_page()
        page.on("console", lambda message: seen.append(f"console: {message.text}"))
        page.on("pageerror", lambda error: seen.append(f"error: {error}"))
        page.on("dialog", lambda dialog: (seen.append("dialog"), dialog.dismiss()))
        page.on("request", lambda request: None if request.url == path.as_uri() else seen.append(request.url))
        page.goto(path.as_uri())
        return page

    yield call
    for context in contexts:
        context.close()
    assert seen == []


@pytest.fixture(scope="session")
def rooms_run(tmp_path_factory):
    """A finished run with its report and its replay."""
    folder = tmp_path_factory.mktemp("browser") / "run"
    arguments = ["--domain", f"{ROOMS}:Rooms", "--searcher", "random", "--budget", "300", "--validation", "60"]
    assert main(["run", *arguments, "--seed", "5", "--out", str(folder), "--quiet"]) == 0
    assert main(["report", str(folder), "--episodes", "30"]) == 0
    assert main(["replay", SWEEPING, "--domain", f"{ROOMS}:Rooms", "-o", str(folder / "replay.html")]) == 0
    assert main(["report", str(folder), str(folder), "--episodes", "30", "-o", str(folder / "both.html")]) == 0
    return folder


@pytest.fixture(scope="session")
def sweeping():
    """What replays play: the tree in notation, and the domain's file and name."""
    return SWEEPING, f"{ROOMS}:Rooms"
