"""Whatever a program does wrong fails one request, says what it was, and the next one is answered."""

import pytest

from grammarbt.errors import DomainError
from grammarbt_exec.domain import make_exec
from grammarbt_exec.parameters import ExecParameters

FAULTS = {
    "dies": r"ended with exit code 3; its standard error ends with: first sign \| last words",
    "crashes": r"was ended by signal 11 \(Segmentation fault",
    "hangs": r"did not answer within 2 s",
    "dribbles": r"did not answer within 2 s, only began: '\.\.\.",
    "floods": r"did not answer within 2 s; its standard error ends with: .*flood",
    "partial": r"did not answer within 2 s, only began: '\{\"id\": \d+",
    "closes": "closed its standard output",
    "garbage": "no JSON.*'Segmentation fault",
    "no-object": r"no JSON object: '\[1,2,3\]'",
    "wrong-id": r"its id is not \d+",
    "no-id": r"its id is not \d+: '\{\"returns\"",
    "too-few": "'returns' has 1 numbers instead of 3",
    "texts": "'returns' is not a list of numbers",
    "nan": "'returns' has a number that is not finite: '.*NaN",
    "infinite": "'returns' has a number that is not finite",
    "wrong-ticks": "'ticks' has 1 numbers instead of 3",
    "half-ticks": "its ticks are not counts",
    "two-lines": "more than one line at once, after the first: 'and another thing",
    "latin": r"byte 1 is not UTF-8: 'd\\\\xe9j\\\\xe0 vu'",
    "deep": "no JSON",
    "huge": "wrote a line longer than 16 MiB",
    "refuses": "refused: no such robot",
    "half-a-letter": r"refused: \\ud800",
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_fails_its_request_and_no_other(make, ask, fault):
    domain = make(fault, timeout=2 if fault in ("hangs", "dribbles", "floods", "partial") else 30)
    assert ask(domain) == [0, 1, 2]
    with pytest.raises(DomainError, match=FAULTS[fault]) as raised:
        ask(domain)
    assert len(raised.value.message) < 1000
    assert ask(domain, scenarios=2) == [0, 1]


@pytest.mark.parametrize("harmless", ["halves", "chatty"])
def test_a_slow_or_chatty_program_is_understood(make, ask, harmless):
    domain = make(harmless)
    assert [ask(domain), ask(domain), ask(domain)] == [[0, 1, 2]] * 3


def test_an_error_shows_only_what_the_program_wrote_since_its_request(make, ask):
    domain = make("dies")
    ask(domain)
    with pytest.raises(DomainError, match="last words"):
        ask(domain)
    ask(domain)
    with pytest.raises(DomainError) as raised:
        ask(domain)
    assert raised.value.message.count("last words") == 1


def test_a_program_that_announces_something_else_when_started_again_is_refused(make, ask, tmp_path):
    domain = make("changes", tmp_path / "mark")
    ask(domain)
    for _ in range(2):
        with pytest.raises(DomainError):
            ask(domain)
    with pytest.raises(DomainError, match="announced something else"):
        ask(domain)


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("", "ended with exit code 0"),
        ("hello", "no JSON"),
        ("[]", "no JSON object"),
        ('{"protocol":1,"groups":[[]]}', r"not a JSON object @ \$\.groups\[0\]"),
        ("{}", r"required field missing @ \$\.protocol"),
        ('{"protocol":2,"groups":[]}', r"2 is not one of 1 @ \$\.protocol"),
        ('{"protocol":1,"groups":[]}', "no leaves"),
        ('{"protocol":1,"groups":[{"name":"g","actions":["a",{"help":"b"}]}]}', r"\$\.groups\[0\]\.actions\[1\]\.name"),
        (
            '{"protocol":1,"groups":[{"name":"g","actions":["a",{"nam":"b"}]}]}',
            r'no key "nam", only name, .* \$.*\[1\]:',
        ),
        ('{"protocol":1,"groups":[{"name":"g","actions":"ab"}]}', r'"ab" is not a list @ \$\.groups\[0\]\.actions'),
        (
            '{"protocol":1,"groups":[{"name":"g","actions":["a"]}],"episodes":1}',
            r"1 is not true or false @ \$\.episodes",
        ),
        ('{"protocol":true,"groups":[]}', r"true is not one of 1 @ \$\.protocol"),
        (
            '{"protocol":1,"groups":[{"name":"g","actions":[{"name":"a","parameters":{"to":"home"}}]}]}',
            r'"home" is not a list @ \$\.groups\[0\]\.actions\[0\]\.parameters\["to"\]',
        ),
        (
            '{"protocol":1,"groups":[{"name":"g","actions":[{"name":"a","results":["done"]}]}]}',
            r'"done" is not one of success, failure, running @ \$.*\.results\[0\]',
        ),
        ('{"protocol":1,"groups":[{"name":"g\\ud800"}]}', r"half of a surrogate pair @ \$\.groups\[0\]\.name"),
        ('{"protocol":1,"groups":[{"name":"g","actions":[3]}]}', r"\$\.groups\[0\]\.actions\[0\]"),
        ('{"protocol":1,"groups":[{"name":"g","actions":["[a]"]}]}', "cannot have the name"),
        ('{"protocol":1,"groups":[{"name":"g"},{"name":"g"}]}', "two groups"),
        ('{"protocol":1,"groups":[{"name":"g","actions":["a"]}],"colour":1}', "colour"),
        (
            '{"protocol":1,"groups":[{"name":"g","actions":["a"]}],"references":[{"name":"m","tree":"[b]"}]}',
            r"no leaf \[b\]",
        ),
    ],
)
def test_a_wrong_announcement_is_refused_with_the_place(tmp_path, line, reason):
    (tmp_path / "line").write_text(f"{line}\n" if line else "")
    with pytest.raises(DomainError, match=reason):
        make_exec(ExecParameters(f"cat '{tmp_path / 'line'}'"))


def test_a_command_that_cannot_run_is_refused(tmp_path):
    script = tmp_path / "script"
    script.write_text("no interpreter is named here")
    script.chmod(0o755)
    for command, reason in {
        "./nothing": "no program './nothing'",
        "'": "cannot read the command",
        " ": "no program",
        str(script): "could not be started; its standard error ends with: Exec format error",
    }.items():
        with pytest.raises(DomainError, match=reason):
            make_exec(ExecParameters(command))


def test_a_program_that_never_announces_itself_is_given_up():
    with pytest.raises(DomainError, match=r"did not answer within 0\.3 s"):
        make_exec(ExecParameters("sleep 600", startup=0.3))
