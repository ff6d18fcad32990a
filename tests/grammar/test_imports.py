"""`%import`: from shipped grammars and neighbours, and never from elsewhere."""

import pytest

from grammarbt.bt import format_tree
from grammarbt.grammar import GrammarFileError, Source, bind, bundled, load_grammar, read_grammar, read_source

HEAD = "%declare ACTION CONDITION\n"


@pytest.fixture
def folder(tmp_path):
    """Writes files and reads `main.grammar`."""

    def write(**texts):
        for name, text in texts.items():
            (tmp_path / f"{name}.grammar").write_text(text, encoding="utf-8")
        return read_grammar(tmp_path / "main.grammar")

    return write


def words(grammar, vocabulary):
    bound = bind(grammar, vocabulary)
    return {format_tree(bound.tree_of(word)) for _, word in bound.enumerate()}


def codes(error):
    return [finding.code for finding in error.value.diagnostics]


def test_imported_language_equals_the_language_written_out(bound, vocabulary):
    text = '%import scheide.subtree\n%forall g in GROUP\n%unique g in start\nstart: "?" "(" each each+ ")"\neach: subtree{g}\n'
    imported = words(load_grammar(Source("x.grammar", text)), vocabulary((1, 1), (1, 2)))
    whole = bound("scheide", (1, 1), (1, 2))
    assert imported == {format_tree(whole.tree_of(word)) for _, word in whole.enumerate()}


def test_constraints_on_imported_rules_come_along_and_others_stay(folder):
    library = HEAD + "%limit nodes 3 in inner\n%limit nodes 9 in other\nouter: inner\ninner: ACTION\nother: ACTION\n"
    grammar = folder(main='%import .library.outer\nstart: "?" "(" outer ")"\n', library=library)
    assert [(limit.most, limit.scope) for limit in grammar.limits] == [(3, "library__inner")]
    assert grammar.rule_names == ("start", "outer", "library__inner")


def test_an_alias_names_the_rule_and_its_constraints(folder, vocabulary):
    library = HEAD + '%unique ACTION in pair\npair: "→" "(" ACTION ACTION ")"\n'
    grammar = folder(main='%import .library.pair -> two\nstart: "?" "(" two ")"\n', library=library)
    assert words(grammar, vocabulary((2, 0))) == {
        "?( →( [a1.0] [a1.1] ) )",
        "?( →( [a1.1] [a1.0] ) )",
    }


def test_one_rule_under_two_names_is_two_rules_alike(folder, vocabulary):
    main = '%import .library.part -> one\n%import .library.part -> two\nstart: "?" "(" one two ")"\n'
    grammar = folder(main=main, library=HEAD + "part: ACTION\n")
    assert len(words(grammar, vocabulary((2, 0)))) == 4


def test_names_of_the_importing_file_do_not_reach_into_the_imported_one(folder, vocabulary):
    main = HEAD + '%import .library.part\nstart: "?" "(" part helper ")"\nhelper: CONDITION\n'
    grammar = folder(main=main, library=HEAD + "part: helper\nhelper: ACTION\n")
    assert words(grammar, vocabulary((1, 1))) == {"?( [a1.0] (c1.0) )"}


def test_a_variable_of_the_imported_file_stays_apart_unless_declared_in_both(folder, vocabulary):
    library = HEAD + "%forall g in GROUP\npart: ACTION{g}\n"
    main = '%import .library.part\n%unique g in start\nstart: "?" "(" part part ")"\n'
    with pytest.raises(GrammarFileError) as error:
        folder(main=main, library=library)
    assert codes(error) == ["G211"]
    shared = folder(main=f"%forall g in GROUP\n{main}", library=library)
    assert words(shared, vocabulary((1, 0), (1, 0))) == {"?( [a1.0] [a2.0] )", "?( [a2.0] [a1.0] )"}


def test_imports_go_through_other_imports(folder, vocabulary):
    grammar = folder(
        main='%import .middle (part)\nstart: "?" "(" part ")"\n',
        middle="%import .last.leaf -> part\n",
        last=HEAD + "leaf: ACTION\n",
    )
    assert words(grammar, vocabulary((1, 0))) == {"?( [a1.0] )"}


def test_circles_of_two_files_are_found(folder):
    with pytest.raises(GrammarFileError) as error:
        folder(main="%import .other.x\nstart: x\n", other="%import .main.start -> x\n")
    assert codes(error) == ["G108"]
    assert error.value.diagnostics[0].span.source.name.endswith("other.grammar")


def test_every_wrong_import_is_reported(folder):
    main = "%import .missing.x\n%import ..up.y\n%import .library (part, prat)\n%import nowhere.z\nstart: part\n"
    with pytest.raises(GrammarFileError) as error:
        folder(main=main, library=HEAD + "part: ACTION\n")
    assert codes(error) == ["G106", "G107", "G109", "G106"]
    assert "did you mean 'part'?" in error.value.render()


def test_errors_in_an_imported_file_are_shown_there(folder):
    with pytest.raises(GrammarFileError) as error:
        folder(main="%import .library.part\nstart: part\n", library="part: (ACTION\n")
    (finding,) = error.value.diagnostics
    assert finding.span.source.name.endswith("library.grammar")


def test_a_folder_or_binary_file_in_place_of_a_neighbour_is_no_grammar(tmp_path):
    (tmp_path / "folder.grammar").mkdir()
    (tmp_path / "binary.grammar").write_bytes(b"\xff\xfe\x00")
    (tmp_path / "main.grammar").write_text("%import .folder.x\n%import .binary.y\nstart: x\n")
    with pytest.raises(GrammarFileError) as error:
        read_grammar(tmp_path / "main.grammar")
    assert codes(error) == ["G106", "G106"]


def test_a_long_chain_of_files_ends_in_a_diagnosis(folder):
    files = {f"f{at}": f"%import .f{at + 1}.x\n" for at in range(200)}
    with pytest.raises(GrammarFileError) as error:
        folder(main="%import .f0.x\nstart: x\n", f200=HEAD + "x: ACTION\n", **files)
    assert "G102" in codes(error)


def test_files_that_import_each_other_many_times_stay_small(folder, vocabulary):
    levels = 12
    files = {
        f"{side}{at}": "\n".join(f"%import .{other}{at + 1}.x -> {other}" for other in "abc") + "\nx: a | b | c\n"
        for at in range(levels)
        for side in "abc"
    }
    ends = {f"{side}{levels}": HEAD + "x: ACTION\n" for side in "abc"}
    grammar = folder(main='%import .a0.x\nstart: "?" "(" x ")"\n', **files, **ends)
    assert len(grammar.rules) == 3 * levels + 2
    assert bind(grammar, vocabulary((1, 0))).productions


def test_a_bundle_is_the_same_language_without_the_files(folder, tmp_path, vocabulary):
    files = {
        "main": '%import .general (part)\n%import general.check\nstart: "?" "(" part check ")"\n',
        "general": "%import .last.leaf\npart: leaf\n",
        "last": HEAD + "leaf: ACTION\n",
    }
    before = bind(folder(**files), vocabulary((2, 1)))
    bundle = bundled(read_source(tmp_path / "main.grammar"))
    for name in files:
        (tmp_path / f"{name}.grammar").unlink()
    assert bundle.neighbours == {name: files[name] for name in ("general", "last")}
    assert bind(load_grammar(bundle), vocabulary((2, 1))).fingerprint == before.fingerprint


def test_a_bundle_without_a_neighbour_says_which_one():
    source = Source("x.grammar", "%import .gone.leaf\nstart: leaf\n", neighbours={})
    with pytest.raises(GrammarFileError) as error:
        load_grammar(source)
    assert codes(error) == ["G106"]
    assert "`gone.grammar` was not kept" in error.value.render()
