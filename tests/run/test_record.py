"""What a run did stands in its journal as JSON, byte for byte as Python's own writer of JSON would put it."""

import json

from hypothesis import given
from hypothesis import strategies as st

from grammarbt.bt import Action, format_tree
from grammarbt.run.evaluate import Trial
from grammarbt.run.folder import RunFolder
from grammarbt.run.journal import Journal
from grammarbt.run.record import Recorder
from grammarbt.search import Evaluation, Proposal

finite = st.floats(allow_nan=False, allow_infinity=False)
numbers = st.lists(finite | st.integers() | st.booleans(), max_size=5).map(tuple)
names = st.sampled_from(["go", 'say "hé"', "C:\\dir", "→ ‖2", "\U0001f916"])


def expected(trial, **more):
    evaluation, proposal = trial.evaluation, trial.evaluation.proposal
    event = {"event": "trial" if more else "selection", "tree": trial.text}
    event |= {"start": proposal.start, "stop": proposal.stop, "simulated": trial.simulated}
    event |= {"status": evaluation.status, "returns": evaluation.returns, "ticks": evaluation.ticks}
    event |= {"error": evaluation.error} if evaluation.error else {}
    return json.dumps(event | more, ensure_ascii=False, allow_nan=False, separators=(",", ":"))


@given(
    name=names, returns=numbers, ticks=numbers, error=st.text(st.characters(codec="utf-8")), start=st.integers(0, 99)
)
def test_a_trial_is_written_as_json_writes_it(name, returns, ticks, error, start, tmp_path_factory):
    tree, status = Action(name), "failed" if error else "ok"
    evaluation = Evaluation(Proposal(tree, None, start, start + 7), returns, ticks, status, error)
    trial = Trial(evaluation, format_tree(tree), len(returns))
    folder = RunFolder(tmp_path_factory.mktemp("run"))
    with Recorder(folder, Journal.open(folder.journal)) as recorder:
        recorder.batch([trial, trial])
        recorder.batch([trial])
        recorder.selection(trial)
    written = [line.split(',"crc":')[0] + "}" for line in folder.journal.read_text("utf-8").split("\n")[:-1]]
    assert written == [*(expected(trial, batch=batch) for batch in (1, 1, 2)), expected(trial)]
