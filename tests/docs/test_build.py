"""The documentation builds without a warning, and its links lead somewhere."""

import re
import subprocess
import sys
from pathlib import Path
from urllib.parse import urlsplit

import pytest

ROOT = Path(__file__).parents[2]
FOLDERS = ("docs", "plugins", "benchmarks", "grammars")
PAGES = sorted([*ROOT.glob("*.md"), *(path for folder in FOLDERS for path in (ROOT / folder).rglob("*.md"))])
PAGES = [path for path in PAGES if "_build" not in path.parts and not any(part.startswith(".") for part in path.parts)]
LINK = re.compile(r"\]\(([^)\s]+)\)")
CODE = re.compile(r"^```.*?^```$|^ {4,}.*?$|`[^`\n]+`", re.DOTALL | re.MULTILINE)


def prose(page):
    """The page without code, in which brackets are no links."""
    return CODE.sub("", page.read_text(encoding="utf-8"))


def test_sphinx_has_nothing_to_say(tmp_path):
    """Warnings include pages that no table of contents names, and links to pages and headings that are not there."""
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-d", str(tmp_path / "doctrees")]
    built = subprocess.run(
        [*command, str(ROOT / "docs"), str(tmp_path / "html")], check=False, capture_output=True, text=True
    )
    assert (built.returncode, built.stderr) == (0, "")
    assert (tmp_path / "html/index.html").exists()


@pytest.mark.parametrize("page", PAGES, ids=lambda path: str(path.relative_to(ROOT)))
def test_links_lead_to_files(page):
    links = [link.partition("#")[0] for link in LINK.findall(prose(page))]
    local = [link for link in links if link and "://" not in link and not link.startswith("mailto:")]
    assert [link for link in local if not (page.parent / link).exists()] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda path: str(path.relative_to(ROOT)))
def test_links_elsewhere_are_whole_and_encrypted(page):
    links = [urlsplit(link) for link in LINK.findall(prose(page)) if "://" in link]
    assert [link.geturl() for link in links if link.scheme != "https" or "." not in link.netloc] == []


def test_what_is_built_is_ignored():
    assert "docs/_build" in (ROOT / ".gitignore").read_text(encoding="utf-8")
