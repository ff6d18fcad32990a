"""Makes the pictures of these pages and of the README: a marine run, its report and a replay of its tree, in Chromium.

python docs/pictures/make.py
"""

import shutil
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from playwright.sync_api import Browser, sync_playwright

from grammarbt.cli import main

HERE = Path(__file__).parent
SEED, BUDGET = "100", "5000"
WIDE = {"width": 1280, "height": 860}


def make(folder: Path, browser: Browser) -> None:
    run = str(folder / "run")
    for line in (
        ["run", "--domain", "marine", "--searcher", "dagmcts", "--budget", BUDGET, "--seed", SEED, "--out", run],
        ["report", run],
        ["replay", run],
        ["tree", "convert", run, "--to", "svg", "-o", str(HERE / "marine.svg")],
        ["report", run, "-o", str(HERE / "curves.svg")],
    ):
        if main(line):
            sys.exit(f"failed: grammarbt {' '.join(line)}")
    shoot(browser, Path(run) / "report.html", "report.png", "light", [])
    shoot(browser, Path(run) / "report.html", "report-dark.png", "dark", [])
    shoot(browser, Path(run) / "replay.html", "replay.png", "light", ["n", "n", "n", "n", "n"])


def shoot(browser: Browser, path: Path, name: str, scheme: str, keys: list[str]) -> None:
    page = browser.new_context(color_scheme=scheme, viewport=WIDE).new_page()
    page.goto(path.as_uri())
    for key in keys:
        page.keyboard.press(key)
    page.screenshot(path=HERE / name)


if __name__ == "__main__":
    with TemporaryDirectory() as folder, sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        make(Path(folder), chromium)
