"""Acting: what an action does to the robot and the cubes, and whether it succeeds."""

from __future__ import annotations

from grammarbt_pickplace.constants import (
    DROPPED,
    DROPPING,
    ELSEWHERE,
    GOAL,
    LOCALISE_FAILS,
    LOSING,
    LOST,
    LOST_ESTIMATE,
    OUTCOME,
    PICK_FAILS,
    PLACE_FAILS,
    PLACE_TABLE,
    POSES,
    REACH,
    SPEED,
)
from grammarbt_pickplace.kernel.chance import goes_wrong, uniform
from grammarbt_pickplace.kernel.measuring import length
from grammarbt_pickplace.program import compiled
from grammarbt_pickplace.state import AT_PICK, AT_PLACE, NOTHING, TUCKED, Record


@compiled
def move(state: Record, place: int) -> bool:
    """Drive to a place; takes the time from where the robot believed to be."""
    x, y = state.estimate[0], state.estimate[1]
    ready = state.localised != 0 and state.head_up != 0 and state.arm in (TUCKED, AT_PICK)
    if ready and state.place != place:
        _drive(state, place)
    state.time += length(state.pose[0] - x, state.pose[1] - y, 0.0) / SPEED
    return bool(state.place == place)


@compiled
def _drive(state: Record, place: int) -> None:
    dropped = state.held != NOTHING and goes_wrong(state, DROPPING, DROPPED)
    lost = goes_wrong(state, LOSING, LOST)
    state.place = ELSEWHERE if dropped or lost else place
    for axis in range(2):
        goal = POSES[place, axis]
        state.pose[axis] = (state.estimate[axis] + goal) / 2.0 if dropped or lost else goal
    if dropped:
        _lose_cube(state)
    if lost:
        state.localised = False
        for axis in range(2):
            state.estimate[axis] = state.pose[axis] + 0.1 * uniform(state, LOST_ESTIMATE + axis)


@compiled
def tuck(state: Record) -> bool:
    """Fold the arm, which lets go of a cube."""
    state.arm = TUCKED
    _lose_cube(state)
    return True


@compiled
def _lose_cube(state: Record) -> None:
    """A held cube goes back to its start."""
    if state.held != NOTHING:
        state.cube[state.held] = state.start[state.held]
        state.held = NOTHING


@compiled
def pick(state: Record) -> bool:
    """Grasp the nearest cube."""
    nearest = state.to_robot[: state.cubes].argmin()
    ready = state.localised != 0 and state.head_up == 0 and state.arm == TUCKED and state.place <= PLACE_TABLE
    success = ready and state.to_robot[nearest] < REACH and not goes_wrong(state, OUTCOME, PICK_FAILS)
    if success:
        state.held = nearest
        state.arm = AT_PICK
    if state.place < PLACE_TABLE:
        state.visited[state.place] = True
    return bool(success)


@compiled
def put(state: Record) -> bool:
    """Put the held cube on its goal."""
    ready = state.held != NOTHING and state.localised != 0 and state.head_up == 0 and state.place == PLACE_TABLE
    success = ready and not goes_wrong(state, OUTCOME, PLACE_FAILS)
    if success:
        state.cube[state.held] = GOAL
        state.held = NOTHING
        state.arm = AT_PLACE
    return bool(success)


@compiled
def localise(state: Record) -> bool:
    """Find out where the robot is."""
    state.localised = not goes_wrong(state, OUTCOME, LOCALISE_FAILS)
    return bool(state.localised)
