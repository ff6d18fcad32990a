"""When programs start, and that none of them outlives who started it."""

import os
import signal
import subprocess
import sys

import numpy as np
import pytest

from grammarbt.bt import Action, Condition, Status, compile_policy, parse
from grammarbt.errors import DomainError

OWNER = """
import sys, time
import numpy as np
from grammarbt_exec.domain import make_exec
from grammarbt_exec.parameters import ExecParameters
domain = make_exec(ExecParameters(sys.argv[1]))
print("ready", flush=True)
if sys.argv[2] == "waits":
    time.sleep(600)
"""


@pytest.fixture
def owner(stray, tmp_path):
    """Starts a Python process that owns a program with a child; gives it and the processes of the program."""
    started = []

    def start(behaviour):
        mark = tmp_path / "mark"
        command = stray("none", mark)
        started.append(
            subprocess.Popen([sys.executable, "-c", OWNER, command, behaviour], stdout=subprocess.PIPE, text=True)
        )
        assert started[-1].stdout.readline() == "ready\n"
        return started[-1], [int(process) for process in mark.read_text().split()]

    yield start
    for process in started:
        process.kill()
        process.wait()
        process.stdout.close()


@pytest.mark.parametrize("sent", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_a_program_and_its_children_end_when_their_worker_is_killed(owner, gone, holds_within, sent):
    process, programs = owner("waits")
    assert not gone(programs[:1])
    assert not gone(programs[1:])
    process.send_signal(sent)
    assert holds_within(5, lambda: gone(programs))


def test_a_program_and_its_children_have_ended_when_their_worker_has(owner, gone, holds_within):
    process, programs = owner("ends")
    process.wait(10)
    assert holds_within(0.5, lambda: gone(programs))


def test_a_program_that_hangs_is_killed_with_its_children(make, gone, holds_within, tmp_path):
    mark = tmp_path / "mark"
    domain = make("none", mark)
    programs = [int(process) for process in mark.read_text().split()]
    os.kill(programs[0], signal.SIGSTOP)
    domain.close()
    assert holds_within(0.5, lambda: gone(programs))


def test_a_program_is_started_once_and_again_after_a_fault(make, ask, tmp_path):
    mark = tmp_path / "mark"
    domain = make("garbage", mark)
    ask(domain)
    assert len(mark.read_text().splitlines()) == 1
    with pytest.raises(DomainError):
        ask(domain)
    ask(domain)
    assert len(mark.read_text().splitlines()) == 2


def test_the_announcement_becomes_the_vocabulary(make):
    domain = make()
    stay, go = Action("stay"), Action("go", (("to", "home"),))
    assert domain.vocabulary.leaves[:3] == (stay, go, Action("go", (("to", "work"),)))
    assert domain.vocabulary.types[go].results == {Status.RUNNING}
    assert domain.vocabulary.is_pure(Condition("near"))
    assert not domain.vocabulary.is_pure(Condition("far"))
    assert (domain.grammar, domain.depends_on) == ("general", "behaviour")
    assert [reference.name for reference in domain.references] == ["manual"]


def test_no_scenarios_are_answered_without_the_program(make, ask):
    domain = make("dies")
    ask(domain)
    assert ask(domain, scenarios=0) == []


def test_leaves_that_are_not_counted_are_not_taken_for_idle(make):
    domain = make()
    policy = compile_policy(parse("?( (near) [stay] )"), domain.vocabulary.index)
    assert domain.simulate(policy, np.arange(2)).ticks.tolist() == [1, 1]
