"""What people see: pages that load alone, play by keyboard, and are open to everyone."""

import pytest
from axe_playwright_python.sync_playwright import Axe

from grammarbt.bt import Status, compile_policy, format_tree, node_statuses, parse
from grammarbt.domain import Episode, Frame
from grammarbt.plugins.resolve import load_from_file
from grammarbt.report.evidence import Evidence
from grammarbt.report.history import Failure, read_history
from grammarbt.report.recording import stops_of, watch
from grammarbt.report.replay import replay_page
from grammarbt.report.single import single_report

COLOURS = {
    Status.SUCCESS: "rgb(143, 214, 148)", Status.FAILURE: "rgb(244, 160, 154)",
    Status.RUNNING: "rgb(156, 196, 245)", None: "rgb(255, 255, 255)",
}  # fmt: skip
CUES = {Status.SUCCESS: "✓", Status.FAILURE: "✗", Status.RUNNING: "…", None: ""}
HOSTILE = "<img src=x onerror=alert`1`>"


@pytest.fixture(scope="module")
def played(sweeping):
    """The tree and the episode that the replay shows."""
    text, reference = sweeping
    domain, tree = load_from_file(reference)(), parse(text)
    return tree, watch(domain, "rooms", compile_policy(tree, domain.vocabulary.index), 0, 0)


@pytest.fixture
def replay(show, rooms_run):
    return show(rooms_run / "replay.html")


def tick(page):
    return int(page.locator("#tick").input_value())


def in_view(page, number):
    """Whether the node of that number stands inside the part of the tree that is shown."""
    return page.evaluate(
        """number => {
            const node = document.querySelectorAll("#tree > g")[number].getBoundingClientRect();
            const region = document.querySelector("#tree").parentElement.getBoundingClientRect();
            return node.left >= region.left && node.right <= region.right && node.top >= region.top && node.bottom <= region.bottom;
        }""",
        number,
    )


@pytest.mark.parametrize("name", ["report.html", "both.html", "replay.html"])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_pages_load_alone_and_axe_finds_nothing_to_object_to(show, rooms_run, name, scheme):
    page = show(rooms_run / name, scheme)
    page.evaluate("document.querySelectorAll('details').forEach(each => { each.open = true; })")
    found = Axe().run(page)
    assert found.response["passes"]
    assert [(each["id"], [node["html"] for node in each["nodes"]]) for each in found.response["violations"]] == []


def test_colours_and_signs_are_the_recorded_statuses_at_every_tick(replay, played):
    tree, episode = played
    look = """() => [...document.querySelectorAll("#tree > g")].map(
        (node) => [getComputedStyle(node.firstElementChild).fill, node.querySelector(".cue").textContent])"""
    recorded = [(None,) * len(replay.evaluate(look)), *(node_statuses(tree, dict(f.answers)) for f in episode.frames)]
    for number, statuses in enumerate(recorded):
        assert tick(replay) == number
        assert replay.evaluate(look) == [[COLOURS[status], CUES[status]] for status in statuses]
        replay.keyboard.press("ArrowRight")
    assert tick(replay) == len(episode.frames)


def test_the_world_shows_what_changed_also_when_going_back(replay):
    def world():
        return replay.locator("#world").inner_html()

    first = world()
    replay.keyboard.press("End")
    last = world()
    replay.keyboard.press("Home")
    assert world() == first != last
    replay.keyboard.press("End")
    assert world() == last


def test_everything_can_be_done_by_keyboard(replay, played):
    tree, episode = played
    stops = [stop.tick for stop in stops_of(tree, episode)]
    press = replay.keyboard.press
    for key, expected in [
        ("End", 20), ("Home", 0), ("ArrowRight", 1), ("ArrowRight", 2), ("ArrowLeft", 1), ("Home", 0),
        ("n", stops[0]), ("n", stops[1]), ("p", stops[0]), ("p", 0), ("ArrowLeft", 0),
    ]:  # fmt: skip
        press(key)
        assert tick(replay) == expected, key
    for _ in range(4):
        press("+")
    assert replay.locator("#speed").input_value() == "60"
    press("Space")
    replay.wait_for_function("document.querySelector('#tick').value === '20'")
    assert replay.locator("#play").inner_text() == "Play"  # at the end it stops


def test_playing_pauses_where_it_is(replay):
    replay.keyboard.press("Space")
    replay.wait_for_function("Number(document.querySelector('#tick').value) >= 2")
    replay.keyboard.press("Space")
    stopped = tick(replay)
    replay.wait_for_timeout(600)
    assert tick(replay) == stopped < 20


def test_every_control_is_reached_by_tab_and_says_its_name(replay):
    names = []
    for _ in range(12):
        replay.keyboard.press("Tab")
        names.append(replay.evaluate("document.activeElement.ariaLabel || document.activeElement.innerText"))
    assert {"To the start", "Step back", "Play", "Step forward", "Next event", "To the end", "Tick"} <= set(names)


def test_a_tree_of_two_hundred_nodes_stays_readable(show, tmp_path):
    tree = parse("?( " + " ".join(f"→( (is ready {at}) [do thing {at}] )" for at in range(67)) + " )")
    failing = ((2 * at, Status.FAILURE) for at in range(60))
    answers = (*failing, (120, Status.SUCCESS), (121, Status.RUNNING))
    path = tmp_path / "large.html"
    path.write_text(replay_page("large", tree, Episode((Frame(answers, 0.0),))), encoding="utf-8")
    page = show(path)
    assert page.locator("#tree > g").count() == 202
    assert page.locator("#tree > g > text").first.evaluate("text => text.getBoundingClientRect().height") >= 10
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    page.keyboard.press("ArrowRight")
    assert in_view(page, 1 + 3 * 60 + 2)
    width = page.locator("#tree").evaluate("tree => tree.getBoundingClientRect().width")
    page.keyboard.press("z")
    assert page.locator("#tree").evaluate("tree => tree.getBoundingClientRect().width") == pytest.approx(width * 1.25)


def test_markup_in_names_and_errors_does_nothing(show, rooms_run, tmp_path):
    tree = parse(f"?( ({HOSTILE}) [</script><script>alert`1`</script>] )")
    frame = Frame(((0, Status.FAILURE), (1, Status.SUCCESS)), 1.0, (), (HOSTILE,))
    (tmp_path / "replay.html").write_text(replay_page(HOSTILE, tree, Episode((frame,))), encoding="utf-8")
    page = show(tmp_path / "replay.html")
    page.keyboard.press("End")
    assert page.locator("img").count() == 0
    assert HOSTILE in page.locator("h1").inner_text()
    assert HOSTILE in page.locator("#now").inner_text()
    history = read_history(rooms_run)
    failed = Failure(1, format_tree(tree), HOSTILE, "<script>alert(1)</script>")
    object.__setattr__(history, "failures", (failed,))
    object.__setattr__(history, "statuses", {HOSTILE: 1})
    (tmp_path / "report.html").write_text(single_report(history, Evidence(0, missing=HOSTILE)), encoding="utf-8")
    page = show(tmp_path / "report.html")
    assert page.locator("img, script").count() == 0
    assert page.locator("td", has_text="<script>alert(1)</script>").count() == 1


def test_a_report_prints_all_of_its_sections(show, rooms_run):
    page = show(rooms_run / "report.html")
    page.emulate_media(media="print")
    assert page.locator("h2:visible").count() == 8
    assert page.pdf().startswith(b"%PDF")
