"""Episodes that programs tell: the ones that are scored where they are right, and an error with its place if not."""

import runpy
from contextlib import closing
from pathlib import Path

import pytest
from told_episodes import EPISODE, TREE, Teller, altered, line, without

from grammarbt.bt import compile_policy, parse
from grammarbt.cli import main
from grammarbt.domain import Watchable
from grammarbt.errors import DomainError

PLAYTHROUGHS = runpy.run_path(str(Path(__file__).with_name("record_playthroughs.py")))["PLAYTHROUGHS"]

WRONG = [
    (("frames",), None, r"null is not a list @ \$\.frames:"),
    (("frames",), [], r"at least one tick @ \$\.frames:"),
    (("frames", 1), [], r"not a JSON object @ \$\.frames\[1\]:"),
    (("frames", 1, "answers"), [], r"the tick goes on with leaf 0, \(near\) @ \$\.frames\[1\]\.answers:"),
    (("frames", 1, "answers"), [[0, "success"]], r"goes on with leaf 1, \[stay\] @ \$\.frames\[1\]\.answers:"),
    (("frames", 0, "answers", 0, 0), 7, r"leaf 7 instead of 0, \(near\) @ \$\.frames\[0\]\.answers\[0\]:"),
    (("frames", 0, "answers", 1, 0), 1, r"leaf 1 instead of 2, \[go\(to=home\)\] @ \$\.frames\[0\]\.answers\[1\]:"),
    (("frames", 0, "answers", 0, 0), -1, "leaf -1 instead of 0"),
    (("frames", 0, "answers", 0, 0), 0.0, r"0\.0 is not an integer @ \$\.frames\[0\]\.answers\[0\]\[0\]:"),
    (("frames", 0, "answers", 0, 0), False, "false is not an integer"),
    (("frames", 0, "answers", 0, 1), "running", r"\(near\) cannot answer running @ \$\.frames\[0\]\.answers\[0\]:"),
    (("frames", 0, "answers", 1, 1), "success", r"\[go\(to=home\)\] cannot answer success"),
    (("frames", 0, "answers", 0, 1), "done", r'"done" is not one of success, failure, running @ .*\[0\]\[1\]:'),
    (("frames", 0, "answers", 0), [0], r"1 values instead of 2 @ \$\.frames\[0\]\.answers\[0\]:"),
    (("frames", 0, "answers", 0), "0f", r'"0f" is not a list'),
    (("frames", 0, "answers", 2), [0, "success"], r"the tick had ended before @ \$\.frames\[0\]\.answers\[2\]:"),
    (("frames", 0, "reward"), "5", r'"5" is not a number @ \$\.frames\[0\]\.reward:'),
    (("frames", 0, "reward"), 10**400, r"not finite @ \$\.frames\[0\]\.reward:"),
    (("frames", 0, "reward"), float("nan"), r"not finite @ \$\.frames\[0\]\.reward:"),
    (("frames", 1, "events"), "home", r'"home" is not a list @ \$\.frames\[1\]\.events:'),
    (("frames", 1, "marks"), [], r'there is no key "marks", only answers, reward, changes, events @ \$\.frames\[1\]:'),
    (("frames", 0, "changes", 1, "name"), "robot", r"a second mark 'robot' @ \$\.frames\[0\]\.changes\[1\]\.name:"),
    (("marks", 1, "name"), "robot", r"a second mark 'robot' @ \$\.marks\[1\]\.name:"),
    (("marks", 0, "shape"), "star", r'"star" is not one of circle, square, .* @ \$\.marks\[0\]\.shape:'),
    (("marks", 0, "role"), "blue", r'"blue" is not one of ground, path, .* @ \$\.marks\[0\]\.role:'),
    (("marks", 0, "label"), "\ud800", r"half of a surrogate pair @ \$\.marks\[0\]\.label:"),
    (("marks", 0, "size"), -1, r"@ \$\.marks\[0\]\.size:"),
    (("marks", 0, "shade"), 2, r"not from 0 to 1 @ \$\.marks\[0\]\.shade:"),
    (("marks", 0, "x"), 1e7, r"times the box away from it @ \$\.marks\[0\]\.x:"),
    (("marks", 0, "colour"), "red", r'there is no key "colour"'),
    (("box",), [0, 0, 1], r"3 values instead of 4 @ \$\.box:"),
    (("box",), [4, 0, 0, 3], r"not left, bottom, right and top of a box.* @ \$\.box:"),
    (("box",), [0, 0, 1e308, -1e308], r"@ \$\.box:"),
    (("title",), "the way home", r'there is no key "title", only frames, marks, box, unit @ \$:'),
]


@pytest.fixture(scope="module")
def told(tmp_path_factory):
    with closing(Teller(tmp_path_factory.mktemp("told"))) as teller:
        yield teller


@pytest.fixture
def watch():
    """The episode of a tree in the scenario of that number."""

    def watch(domain, tree=TREE, scenario=5):
        return domain.episode(compile_policy(parse(tree), domain.vocabulary.index), scenario)

    return watch


@pytest.mark.parametrize("world", PLAYTHROUGHS.worlds)
def test_the_example_goes_through_the_recorded_ticks(world):
    assert PLAYTHROUGHS.told(world) == PLAYTHROUGHS.recorded(world)


def test_an_episode_is_as_the_program_tells_it(told):
    episode = told(line(EPISODE))
    first, second = episode.frames
    assert (episode.box, episode.unit, [mark.name for mark in episode.marks]) == (
        (0, 0, 4, 3),
        "steps",
        ["robot", "goal"],
    )
    assert (first.answers, second.answers) == (((0, 0), (2, 2)), ((0, 1), (1, 1)))
    assert (first.reward, second.reward, second.events) == (-1, 9.5, ("home",))


def test_a_mark_that_is_told_again_as_it_was_is_no_change(told):
    first, second = told(line(EPISODE)).frames
    assert [(mark.name, mark.x) for mark in first.changes] == [("robot", 2)]
    assert second.changes == ()


@pytest.mark.parametrize(("path", "value", "reason"), WRONG, ids=[f"{way[-1]}={value}"[:40] for way, value, _ in WRONG])
def test_a_wrong_episode_is_refused_with_the_place_and_the_next_is_read(told, path, value, reason):
    with pytest.raises(DomainError, match=reason) as raised:
        told(line(altered(path, value)))
    assert "did not answer the request" in raised.value.message
    assert len(raised.value.message) < 1000
    assert len(told(line(EPISODE)).frames) == 2


@pytest.mark.parametrize("path", [("frames",), ("frames", 0, "answers"), ("frames", 0, "reward"), ("marks", 0, "x")])
def test_what_is_missing_is_named(told, path):
    with pytest.raises(DomainError, match=rf"required field missing @ \$.*\.{path[-1]}:"):
        told(line(without(path)))


@pytest.mark.parametrize(
    ("fault", "reason"),
    {
        "dies": r"ended with exit code 3; its standard error ends with: first sign \| last words",
        "hangs": r"did not answer within 2 s",
        "partial": r"did not answer within 2 s, only began: '\{\"id\": \d+",
        "garbage": "no JSON.*'Segmentation fault",
        "wrong-id": r"its id is not \d+",
        "two-lines": "more than one line at once, after the first: 'and another thing",
        "huge": "wrote a line longer than 16 MiB",
        "refuses": "refused: no such robot",
    }.items(),
)
def test_a_program_that_fails_an_episode_tells_the_next(make, watch, fault, reason):
    domain = make(fault, timeout=2 if fault in ("hangs", "partial") else 30)
    assert watch(domain).frames[-1].reward == 5
    with pytest.raises(DomainError, match=reason):
        watch(domain)
    assert watch(domain, scenario=6).frames[-1].reward == 6


def test_a_program_that_announces_no_episodes_is_scored_and_cannot_be_watched(make, ask, stray, tmp_path, capsys):
    domain = make("silent")
    assert not isinstance(domain, Watchable)
    assert ask(domain) == [0, 1, 2]
    settings = ["--domain", "exec", "--set", f"domain.command={stray('silent')}"]
    assert main(["replay", TREE, *settings, "-o", str(tmp_path / "page.html")]) == 2
    said = capsys.readouterr().err
    assert "domain 'exec' cannot show an episode" in said
    assert "announces" in said


def test_replay_shows_what_the_program_tells_and_its_fault_in_a_line(told, tmp_path, capsys):
    page = tmp_path / "page.html"
    command = ["replay", TREE, "--domain", "exec", "--set", f"domain.command={told.command}", "-o", str(page)]
    told.answer.write_text(line(EPISODE))
    assert main(command) == 0
    assert '"unit":"steps"' in page.read_text(encoding="utf-8")
    told.answer.write_text(line(without(("frames", 1, "reward"))))
    assert main(command) == 2
    assert "required field missing @ $.frames[1].reward" in capsys.readouterr().err
