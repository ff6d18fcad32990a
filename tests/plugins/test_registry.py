"""Names become components; what cannot be made is one clear error."""

import pytest
from attrs import field, frozen

from grammarbt.domain import NoParameters
from grammarbt.errors import DomainError, GrammarBTError, ParameterError, PluginError, UnknownNameError
from grammarbt.plugins import DomainSpec, GrammarSpec, PluginHost, PluginOptions, Registry, SearcherSpec
from grammarbt.plugins.plugin import NOTHING, Plugin

TOY = """
import attrs
from sibling import SIZE
from grammarbt.bt import Status
from grammarbt.domain import ConditionType, Group, TickDomain, Vocabulary

class Toy(TickDomain):
    vocabulary = Vocabulary((Group("g", conditions=(ConditionType("lit"),)),))

    def reset(self, rng): self.lit = rng.random() < 0.5
    def condition(self, name): return self.lit
    def action(self, name): return Status.SUCCESS
    def step(self): self.reward, self.done = float(SIZE), True

@attrs.define
class Sized(Toy):
    size: int = 3

ready = Toy()

class Abstract(TickDomain):
    pass

class Hollow:
    vocabulary = Toy.vocabulary
"""


@frozen
class Host:
    """A host with plugins made up for the test."""

    plugins: tuple[Plugin, ...] = field(converter=tuple)


def registry_with(**provides):
    return Registry(Host([Plugin("odd", "grammarbt-odd", "4.2", provides=NOTHING | provides)]))


@pytest.fixture
def core():
    return Registry(PluginHost(PluginOptions(("all",)), pytest.fail))


@pytest.fixture
def toy(tmp_path):
    (tmp_path / "sibling.py").write_text("SIZE = 7\n")
    (tmp_path / "toy.py").write_text(TOY)
    return f"{tmp_path}/toy.py"


@pytest.mark.parametrize("name", ["Toy", "Sized", "ready"])
def test_domain_comes_from_a_plain_file(core, toy, name):
    domain = core.make_domain(f"{toy}:{name}", {})
    assert [leaf.name for leaf in domain.vocabulary.leaves] == ["lit"]


def test_attrs_class_in_a_file_takes_settings_and_others_do_not(core, toy):
    assert core.make_domain(f"{toy}:Sized", {"size": "5"}).size == 5
    with pytest.raises(ParameterError, match=r"unknown parameter domain\.size"):
        core.make_domain(f"{toy}:Toy", {"size": "5"})


@pytest.mark.parametrize(
    ("reference", "reason"),
    [
        ("absent.py:Toy", "there is no file absent.py"),
        ("{toy}", "does not say which class to use .*toy.py:NAME; it has Abstract, Hollow, Sized, Toy, ready"),
        ("{toy}:Tpy", "has no 'Tpy' .did you mean 'Toy'"),
        ("{toy}:Abstract", "cannot be made: TypeError: Can't instantiate abstract class Abstract"),
        ("{toy}:Hollow", "has no 'grammar'"),
    ],
)
def test_unusable_file_domain_is_one_clear_error(core, toy, reference, reason):
    with pytest.raises(GrammarBTError, match=reason):
        core.make_domain(reference.format(toy=toy), {})


@pytest.mark.parametrize(
    ("source", "reason"),
    [
        ("x = 1\ndef f(:\n", "line 2: SyntaxError"),
        ("x = 1\n\nx.missing\n", "line 3: AttributeError: 'int' object has no attribute 'missing'"),
        ("import no_such_module\n", "line 1: ModuleNotFoundError: No module named 'no_such_module'"),
    ],
)
def test_file_that_does_not_run_is_an_error_with_its_line(core, tmp_path, source, reason):
    (tmp_path / "wrong.py").write_text(source)
    with pytest.raises(DomainError, match=reason) as caught:
        core.make_domain(f"{tmp_path}/wrong.py:Toy", {})
    assert "\n" not in caught.value.message


@pytest.mark.parametrize("kind", ["domain", "searcher", "executor", "format"])
def test_unknown_name_is_an_error_of_its_kind(core, kind):
    with pytest.raises(UnknownNameError, match=f"unknown {kind} 'nonesuch'"):
        getattr(core, kind)("nonesuch")


def test_near_name_is_suggested(core):
    with pytest.raises(UnknownNameError, match="did you mean 'random'"):
        core.searcher("randon")


@pytest.mark.parametrize("path", ["no_such_module:Class", "grammarbt.errors:NoSuchName", "nonsense"])
def test_factory_that_cannot_be_loaded_names_its_plugin(path):
    registry = registry_with(domains=(DomainSpec("toy", path),))
    with pytest.raises(PluginError, match=r"plugin 'odd' of grammarbt-odd 4\.2 cannot load"):
        registry.make_domain("toy", {})


def test_factory_that_raises_names_its_plugin():
    registry = registry_with(domains=(DomainSpec("toy", "builtins:int"),))
    with pytest.raises(
        PluginError, match=r"domain 'toy' of plugin 'odd' of grammarbt-odd 4\.2 cannot be made: TypeError"
    ):
        registry.make_domain("toy", {})


def test_searcher_is_called_with_its_context_and_its_parameters():
    registry = registry_with(searchers=(SearcherSpec("pair", "builtins:slice"),))
    pair = registry.make_searcher("pair", "the context", {})
    assert (pair.start, pair.stop) == ("the context", NoParameters())


def test_grammar_is_found_by_its_name_or_its_path(core, tmp_path):
    path = tmp_path / "mine.grammar"
    path.write_text(core.find_grammar("scheide").text)
    assert core.find_grammar(str(path)).text == core.find_grammar("scheide").text


def test_grammar_of_a_plugin_is_read_from_its_package():
    registry = registry_with(grammars=(GrammarSpec("language", "grammarbt.grammar", "grammar.lark"),))
    assert "start" in registry.find_grammar("language").text


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("schiede", "unknown grammar 'schiede' .did you mean 'scheide'"),
        ("absent.grammar", "cannot read the grammar 'absent.grammar'"),
        ("lost", r"plugin 'odd' of grammarbt-odd 4\.2 lacks its grammar 'lost'"),
    ],
)
def test_grammar_that_is_not_there_is_one_clear_error(name, reason):
    registry = registry_with(grammars=(GrammarSpec("lost", "grammarbt.grammar", "absent.grammar"),))
    with pytest.raises(GrammarBTError, match=reason):
        registry.find_grammar(name)
