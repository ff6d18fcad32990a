"""`grammarbt replay`: an episode as a page, a picture or a log."""

import numpy as np
import pytest
from PIL import Image

from grammarbt.bt import compile_policy, parse
from grammarbt.cli import main
from grammarbt.domain import FIRST_VALIDATION_SCENARIO, scenario_numbers
from grammarbt.plugins.resolve import load_from_file
from grammarbt.report.recording import watch

TREE = "?( →( (dirty) [sweep] ) [move] )"


@pytest.fixture
def replay(rooms, tmp_path):
    """Plays the tree into a file and gives its path."""

    def call(name, *arguments):
        path = tmp_path / name
        assert main(["replay", TREE, "--domain", f"{rooms}:Rooms", "-o", str(path), *arguments]) == 0
        return path

    return call


def test_a_run_plays_in_its_own_domain_into_its_folder(run, capsys):
    assert main(["replay", str(run)]) == 0
    assert capsys.readouterr().out.strip() == str(run / "replay.html")
    assert '"unit":"rooms"' in (run / "replay.html").read_text(encoding="utf-8")


def test_scenarios_are_the_fresh_worlds_of_the_seed(rooms):
    domain = load_from_file(f"{rooms}:Rooms")()
    policy = compile_policy(parse(TREE), domain.vocabulary.index)
    first = FIRST_VALIDATION_SCENARIO
    returns = domain.simulate(policy, scenario_numbers(9, first, first + 5)).returns
    rewards = [watch(domain, "rooms", policy, 9, number).frames[-1].reward for number in range(5)]
    assert np.array_equal(returns, rewards)
    assert len(set(rewards)) > 1


def test_a_gif_has_a_picture_for_every_state(replay):
    with Image.open(replay("episode.gif")) as picture:
        assert picture.n_frames == 21


def test_a_still_shows_the_tick_asked_for(replay):
    assert replay("first.png", "--tick", "0").read_bytes() != replay("last.png").read_bytes()
    assert replay("last.pdf").read_bytes().startswith(b"%PDF")


def test_a_log_for_groot_is_written(replay):
    assert replay("episode.btlog").read_bytes().startswith(b"BTCPP4-FileLogger2")


def test_a_tick_beyond_the_end_is_refused(rooms, tmp_path, capsys):
    arguments = ["replay", TREE, "--domain", f"{rooms}:Rooms", "--tick", "99", "-o", str(tmp_path / "x.png")]
    assert main(arguments) == 2
    assert "choose one from 0 to 20" in capsys.readouterr().err


def test_a_domain_that_cannot_be_watched_is_refused_with_a_hint(rooms, tmp_path, capsys):
    assert main(["replay", TREE, "--domain", f"{rooms}:Unseen", "-o", str(tmp_path / "x.html")]) == 2
    error, hint = capsys.readouterr().err.splitlines()
    assert error.startswith("error: domain")
    assert "cannot show an episode" in error
    assert "`episode`" in hint


def test_an_unknown_format_is_refused(capsys):
    assert main(["replay", TREE, "--format", "mp4"]) == 2
    assert "choose one of html, gif" in capsys.readouterr().err
