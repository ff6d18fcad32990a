"""Leaves: when an action node acts, what each action is, and what answers a condition, by its place in `LEAVES`."""

from __future__ import annotations

from grammarbt_pickplace.constants import SECONDS
from grammarbt_pickplace.kernel.acting import localise, move, pick, put, tuck
from grammarbt_pickplace.kernel.measuring import update
from grammarbt_pickplace.program import FAILURE, RUNNING, SUCCESS, compiled
from grammarbt_pickplace.state import FRESH, NOTHING, TUCKED, Record

MOVE_TO_PLACE, TUCK, PICK, PLACE, LOCALISE, HEAD_UP = range(3, 9)
"""Actions; the code of a move is that of the place where it leads."""
HAVE_BLOCK, TASK_DONE, CUBE0_PLACED = range(10, 13)
TABLE0_VISITED = 15


@compiled
def visit(state: Record, memory: Record, leaf: int) -> int:
    """Tick an action node, or ask a condition; gives the status."""
    if leaf >= HAVE_BLOCK:
        return SUCCESS if _holds(state, leaf) else FAILURE
    if memory.running != state.tick - 1 and not _in_effect(state, leaf):
        memory.status = FRESH
    if memory.status == FRESH:
        _set_at_work(state, leaf, at_work=True)
        memory.status = RUNNING
    elif memory.status == RUNNING:
        _set_at_work(state, leaf, at_work=False)
        memory.status = SUCCESS if _act(state, leaf) else FAILURE
    if memory.status == RUNNING:
        memory.running = state.tick
    return int(memory.status)


@compiled
def _holds(state: Record, condition: int) -> bool:
    if condition == HAVE_BLOCK:
        answer = state.held != NOTHING
    elif condition == TASK_DONE:
        answer = state.to_goal[: state.cubes].max() == 0.0
    elif condition < TABLE0_VISITED:
        answer = state.to_goal[condition - CUBE0_PLACED] == 0.0 and state.held == NOTHING
    else:
        answer = state.visited[condition - TABLE0_VISITED] != 0
    return bool(answer)


@compiled
def _in_effect(state: Record, action: int) -> bool:
    """Whether the action's effect holds, so that its node keeps its answer."""
    if action <= MOVE_TO_PLACE:
        answer = state.place == action
    elif action == TUCK:
        answer = state.arm == TUCKED
    elif action == PICK:
        answer = state.held != NOTHING
    elif action == PLACE:
        answer = state.held == NOTHING
    elif action == LOCALISE:
        answer = state.localised != 0
    elif action == HEAD_UP:
        answer = state.head_up != 0 or state.handling != 0
    else:
        answer = state.head_up == 0 or state.moving != 0
    return bool(answer)


@compiled
def _set_at_work(state: Record, action: int, at_work: bool) -> None:
    if action <= MOVE_TO_PLACE:
        state.moving = at_work
    elif action <= PLACE:
        state.handling = at_work


@compiled
def _act(state: Record, action: int) -> bool:
    """Do the action, and let its time pass; whether it succeeded."""
    state.acts += 1
    state.time += SECONDS[action]
    if action >= HEAD_UP:
        state.head_up = action == HEAD_UP
        return True
    success = _do(state, action)
    update(state)
    return success


@compiled
def _do(state: Record, action: int) -> bool:
    if action <= MOVE_TO_PLACE:
        success = move(state, action)
    elif action == TUCK:
        success = tuck(state)
    elif action == PICK:
        success = pick(state)
    elif action == PLACE:
        success = put(state)
    else:
        success = localise(state)
    return success
