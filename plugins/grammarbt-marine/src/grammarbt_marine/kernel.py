"""The simulator: what each leaf does to the world, compiled.

The rules of time. The robots sense at the start and after every step. An action takes one step, failing ones too; only
`go to comms` and `resurface` take none when already there. A tick in which nothing took a step costs one. A robot on an
edge that takes several steps is not ticked and does not sense until it arrives. The episode ends with the horizon's
last step, also in the middle of a tick. In each step the robots of a team act one after the other, in the order of
their numbers; a robot whose battery is dead does nothing more.

What a team shares. Each robot has a belief, a memory of visited vertices and a noise of its own. The sea is one: a mine
is disarmed once, an object picked up once, a target rewarded once. Which targets were reported a robot learns when it
is in comms, at the end of a step.

Where the scenario's definition left a choice: Among equally near vertices the lowest number is the nearest. Work on a
mine or an object goes on after an interruption, but is lost when the robot leaves the vertex. Where a robot tried to
disarm or pick up something that is not there, it ceases to believe in it; a detector cannot bring it back. A reported
vertex is neither found nor likely any more. A battery is recharged whenever the robot arrives at the surface alive.

Chance is a function of (scenario, robot, step, what it decides), not a stream: trees that have done the same so far go
on to see the same, and what a sensor shows of a vertex at a step is the same for every tree.

All compiled functions stand in this one file, because numba's cache notices a change only in the file of the function
that is called.
"""

from __future__ import annotations

import numpy as np

from grammarbt_marine import layouts, state
from grammarbt_marine.program import FAILURE, RUNNING, SUCCESS, Program, cached, compiled, numpy_integers
from grammarbt_marine.records import Records
from grammarbt_marine.state import Episodes, Room, World

GO_TO_COMMS, RESURFACE, REPORT, DISARM, PICK_UP, TAKE_TO_DROP_OFF = range(6)
GO_TO_LIKELY_TARGET, RANDOM_WALK, SHORTEST_PATH = range(6, 9)
IN_COMMS, TARGET_FOUND, AT_SURFACE, MINE_FOUND, IS_ARMED = range(10, 15)
OBJECT_FOUND, CARRYING_OBJECT, LIKELY_TARGET_FOUND = range(15, 18)

PLACING, SENSING, WALKING = numpy_integers(0, 1, 2)
START, DROP_OFF = numpy_integers(layouts.START, layouts.DROP_OFF)
NOTHING, TARGET, MINE, OBJECT = numpy_integers(state.NOTHING, state.TARGET, state.MINE, state.OBJECT)
LEAST_BELIEF = 1e-12
"""A classifying robot is never surer than this that a class is not there, so that it can change its mind."""


@cached
def simulate(program: Program, room: Room, roadmaps: Records, rules: Records, episodes: Episodes) -> None:
    """Run an episode per scenario, scenario i on roadmap i modulo their number; fill in their returns and the ticks.

    Args:
        program: what each robot does; the ticks of all robots and episodes are counted there.
        room: overwritten; says how many robots there are.
        roadmaps: records of `Roadmap`.
        rules: one record of `Rules`.
        episodes: which scenarios; the returns go there.
    """
    robots, sea = room.robots, room.sea[0]
    for index in range(episodes.scenarios.size):
        scenario = episodes.scenarios[index]
        roadmap = roadmaps[scenario % roadmaps.size]
        for number in range(robots.size):
            _begin(World(robots[number], sea, roadmap, rules[0]), scenario, number)
        while sea.step < rules[0].horizon:
            for number in range(robots.size):
                _take_step(program, World(robots[number], sea, roadmap, rules[0]))
            sea.step += 1
            for number in range(robots.size):
                _sense(World(robots[number], sea, roadmap, rules[0]))
                if robots.size > 1:
                    _hear(World(robots[number], sea, roadmap, rules[0]))
        episodes.returns[index] = sea.reward


@compiled
def _take_step(program: Program, world: World) -> None:
    """Go on with the robot's tick, and then with the next one, until something takes a step."""
    robot = world.robot
    if robot.under_way > 0:
        robot.under_way -= 1
    elif robot.travelled < world.rules.battery_dead:
        idle = robot.entry < 0
        at = 0 if idle else robot.entry
        while True:
            entry = program.entries[at]
            program.ticks[entry.occurrence] += 1
            status = _visit(world, entry.leaf)
            at = entry.follow[status]
            takes_step = entry.leaf < IN_COMMS and (entry.leaf > RESURFACE or status != SUCCESS)
            if takes_step or (at < 0 and idle):
                break
            if at < 0:
                at, idle = 0, True
        robot.entry = at


@compiled
def _visit(world: World, leaf: int) -> int:
    if leaf < IN_COMMS:
        return _act(world, leaf)
    return SUCCESS if _holds(world, leaf) else FAILURE


@compiled
def _begin(world: World, scenario: int, number: int) -> None:
    """Place the robot at the start; the first one also lays out the sea."""
    robot = world.robot
    robot.key = _mix(np.uint64(scenario)) + (np.uint64(number) << np.uint64(56))
    robot.entry = -1
    robot.vertex = START
    robot.under_way = robot.work = 0
    robot.travelled = 0.0
    robot.carrying = False
    for vertex in range(robot.visited.size):
        robot.visited[vertex] = vertex == START
        robot.told[vertex] = False
        for kind in range(world.rules.prior.size):
            robot.belief[kind, vertex] = world.rules.prior[kind]
    if number == 0:
        _fill(world)
    _sense(world)


@compiled
def _fill(world: World) -> None:
    """Shuffle as many vertices as there are things, the start and the drop-off left out."""
    sea = world.sea
    sea.step = 0
    sea.reward = 0.0
    for vertex in range(sea.content.size):
        sea.content[vertex] = NOTHING
        sea.disarmed[vertex] = sea.reported[vertex] = False
    free = sea.places[DROP_OFF + 1 :]
    for place in range(free.size):
        free[place] = DROP_OFF + 1 + place
    placed = 0
    for kind in range(3):
        for _ in range(world.roadmap.count[kind]):
            other = placed + int(_uniform(world, PLACING, placed) * (free.size - placed))
            free[placed], free[other] = free[other], free[placed]
            sea.content[free[placed]] = kind
            placed += 1


@compiled
def _uniform(world: World, decides: int, item: int) -> float:
    """A number from 0 to below 1, with 53 random bits."""
    counter = np.uint64((decides << 48) + (world.sea.step << 24) + item)
    return float(_mix(world.robot.key + counter) >> np.uint64(11)) * 2.0**-53


@compiled
def _mix(number: np.uint64) -> np.uint64:
    """Scramble 64 bits (the SplitMix64 generator of Steele, Lea and Flood, 2014)."""
    number = (number + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)
    number = (number ^ (number >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    number = (number ^ (number >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return number ^ (number >> np.uint64(31))


@compiled
def _sense(world: World) -> None:
    """Unless it is under way or lost, look at every vertex in range and update the belief by Bayes' rule."""
    robot = world.robot
    if robot.under_way > 0 or robot.travelled >= world.rules.battery_dead:
        return
    if world.rules.classifies:
        _classify(world)
    else:
        _detect(world)


@compiled
def _hear(world: World) -> None:
    """Learn in comms what the others reported."""
    robot, sea = world.robot, world.sea
    if world.roadmap.comms[robot.vertex]:
        for vertex in range(sea.reported.size):
            robot.told[vertex] |= sea.reported[vertex]


@compiled
def _detect(world: World) -> None:
    """Look for each class on its own."""
    robot, sea, roadmap = world.robot, world.sea, world.roadmap
    here = robot.vertex
    for place in range(roadmap.reach[here]):
        vertex = roadmap.in_range[here, place]
        for kind in range(3):
            present = sea.content[vertex] == kind
            chance = roadmap.detection[here, place, kind] if present else world.rules.false_alarm[kind]
            detected = _uniform(world, SENSING, vertex * 3 + kind) < chance
            robot.belief[kind, vertex] += (
                roadmap.gain[here, place, kind] if detected else roadmap.loss[here, place, kind]
            )


@compiled
def _classify(world: World) -> None:
    """Read one of the four classes; the last is nothing."""
    robot, sea, roadmap, rules = world.robot, world.sea, world.roadmap, world.rules
    for place in range(roadmap.reach[robot.vertex]):
        vertex = roadmap.in_range[robot.vertex, place]
        beyond = _uniform(world, SENSING, vertex * 3) - rules.right
        mistaken = 0 if beyond < 0.0 else 1 + int(beyond / rules.wrong) % 3
        reading = (sea.content[vertex] + mistaken) % 4
        total = 0.0
        for kind in range(4):
            robot.belief[kind, vertex] *= rules.right if kind == reading else rules.wrong
            total += robot.belief[kind, vertex]
        for kind in range(4):
            robot.belief[kind, vertex] = max(robot.belief[kind, vertex] / total, LEAST_BELIEF)


@compiled
def _holds(world: World, condition: int) -> bool:
    robot = world.robot
    if condition == IN_COMMS:
        answer = bool(world.roadmap.comms[robot.vertex])
    elif condition == TARGET_FOUND:
        answer = _target_found(world)
    elif condition == AT_SURFACE:
        answer = bool(world.roadmap.surface[robot.vertex])
    elif condition == MINE_FOUND:
        answer = _found(world, MINE, robot.vertex)
    elif condition == IS_ARMED:
        answer = not world.sea.disarmed[robot.vertex]
    elif condition == OBJECT_FOUND:
        answer = bool(robot.carrying) or _found(world, OBJECT, robot.vertex)
    elif condition == CARRYING_OBJECT:
        answer = bool(robot.carrying)
    elif condition == LIKELY_TARGET_FOUND:
        answer = _nearest_likely_target(world) != NOTHING
    else:
        answer = bool(robot.travelled >= world.rules.battery_low)
    return answer


@compiled
def _found(world: World, kind: int, vertex: int) -> bool:
    return bool(world.robot.belief[kind, vertex] > world.rules.found[kind])


@compiled
def _target_found(world: World) -> bool:
    for vertex in range(world.sea.content.size):
        if _found(world, TARGET, vertex) and not world.robot.told[vertex]:
            return True
    return False


@compiled
def _act(world: World, action: int) -> int:
    """Do at most one step of the action."""
    here = world.robot.vertex
    if action == GO_TO_COMMS:
        status = _go_up(world, world.roadmap.nearest_comms[here])
    elif action == RESURFACE:
        status = _go_up(world, world.roadmap.nearest_surface[here])
    elif action == REPORT:
        status = _report(world)
    elif action == DISARM:
        status = _disarm(world)
    elif action == PICK_UP:
        status = _pick_up(world)
    elif action == TAKE_TO_DROP_OFF:
        status = _take_to_drop_off(world)
    elif action == GO_TO_LIKELY_TARGET:
        status = _go(world, _nearest_likely_target(world))
    elif action == RANDOM_WALK:
        status = _random_walk(world)
    elif action == SHORTEST_PATH:
        status = _go(world, _nearest_unvisited(world))
    else:
        status = _go(world, _next_of_sweep(world))
    return status


@compiled
def _go_up(world: World, goal: int) -> int:
    return SUCCESS if goal == world.robot.vertex else _go(world, goal)


@compiled
def _go(world: World, goal: int) -> int:
    """Set out along one edge towards the goal, or stay there; fails without a goal."""
    if goal == NOTHING:
        return FAILURE
    _move(world, world.roadmap.next_hop[world.robot.vertex, goal])
    return RUNNING


@compiled
def _move(world: World, vertex: int) -> None:
    robot, rules = world.robot, world.rules
    if vertex == robot.vertex:
        return
    if rules.costs_matter:
        cost = world.roadmap.distance[robot.vertex, vertex]
        robot.under_way = int(np.ceil(cost / rules.speed)) - 1
        robot.travelled += cost
        if world.roadmap.surface[vertex] and robot.travelled < rules.battery_dead:
            robot.travelled = 0.0
    robot.work = 0
    robot.vertex = vertex
    robot.visited[vertex] = True


@compiled
def _nearest_likely_target(world: World) -> int:
    robot, rules = world.robot, world.rules
    distance = world.roadmap.distance[robot.vertex]
    nearest = NOTHING
    for vertex in range(distance.size):
        likely = rules.likely < robot.belief[TARGET, vertex] <= rules.found[TARGET] and not robot.told[vertex]
        if likely and (nearest == NOTHING or distance[vertex] < distance[nearest]):
            nearest = vertex
    return nearest


@compiled
def _nearest_unvisited(world: World) -> int:
    distance = world.roadmap.distance[world.robot.vertex]
    nearest = NOTHING
    for vertex in range(distance.size):
        if not world.robot.visited[vertex] and (nearest == NOTHING or distance[vertex] < distance[nearest]):
            nearest = vertex
    return nearest


@compiled
def _next_of_sweep(world: World) -> int:
    for vertex in world.roadmap.sweep:
        if not world.robot.visited[vertex]:
            return int(vertex)
    return NOTHING


@compiled
def _random_walk(world: World) -> int:
    robot = world.robot
    edge = int(_uniform(world, WALKING, START) * world.roadmap.degree[robot.vertex])
    _move(world, world.roadmap.neighbours[robot.vertex, edge])
    return RUNNING


@compiled
def _report(world: World) -> int:
    """Report every vertex where a target was found; only the right ones are rewarded."""
    robot, sea = world.robot, world.sea
    if not world.roadmap.comms[robot.vertex]:
        return FAILURE
    for vertex in range(sea.content.size):
        if _found(world, TARGET, vertex) and not robot.told[vertex]:
            if sea.content[vertex] == TARGET and not sea.reported[vertex]:
                sea.reward += world.rules.reward[TARGET]
            robot.told[vertex] = sea.reported[vertex] = True
    return SUCCESS


@compiled
def _disarm(world: World) -> int:
    robot, sea = world.robot, world.sea
    if sea.disarmed[robot.vertex]:
        return SUCCESS
    status = _work(world, MINE, world.rules.disarm_steps)
    if status == SUCCESS:
        sea.disarmed[robot.vertex] = True
        sea.reward += world.rules.reward[MINE]
    return status


@compiled
def _pick_up(world: World) -> int:
    robot, sea = world.robot, world.sea
    if robot.carrying:
        return FAILURE
    status = _work(world, OBJECT, world.rules.pick_up_steps)
    if status == SUCCESS:
        robot.carrying = True
        robot.belief[OBJECT, robot.vertex] = world.rules.impossible
        sea.content[robot.vertex] = NOTHING
        sea.reward += world.rules.pick_up_reward
    return status


@compiled
def _work(world: World, kind: int, steps: int) -> int:
    """One step of work on the thing here; fails, and the robot knows better, when there is none."""
    robot = world.robot
    if world.sea.content[robot.vertex] != kind:
        robot.belief[kind, robot.vertex] = world.rules.impossible
        return FAILURE
    robot.work += 1
    return SUCCESS if robot.work >= steps else RUNNING


@compiled
def _take_to_drop_off(world: World) -> int:
    robot = world.robot
    if not robot.carrying:
        return FAILURE
    if robot.vertex != DROP_OFF:
        return _go(world, DROP_OFF)
    robot.carrying = False
    world.sea.reward += world.rules.reward[OBJECT]
    return SUCCESS
