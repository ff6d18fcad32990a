"""Episodes: how they begin, whose turn it is, and what a tick of a robot's tree is."""

from __future__ import annotations

from grammarbt_marine.kernel.chance import robot_key, uniform
from grammarbt_marine.kernel.codes import DROP_OFF, NOTHING, PLACING, START
from grammarbt_marine.kernel.leaves import takes_step, visit
from grammarbt_marine.kernel.sensing import hear, sense
from grammarbt_marine.program import Program, cached, compiled
from grammarbt_marine.records import Records
from grammarbt_marine.state import Episodes, Room, World


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
                sense(World(robots[number], sea, roadmap, rules[0]))
                if robots.size > 1:
                    hear(World(robots[number], sea, roadmap, rules[0]))
        episodes.returns[index] = sea.reward


@compiled
def _begin(world: World, scenario: int, number: int) -> None:
    """Place the robot at the start; the first one also lays out the sea."""
    robot = world.robot
    robot.key = robot_key(scenario, number)
    robot.entry = -1
    robot.vertex = START
    robot.under_way = robot.work = 0
    robot.travelled = 0.0
    robot.carrying = False
    _forget(world)
    if number == 0:
        _empty(world)
        _fill(world)
    sense(world)


@compiled
def _forget(world: World) -> None:
    """What the robot knows at the start, before it looks round."""
    robot, prior = world.robot, world.rules.prior
    for vertex in range(robot.visited.size):
        robot.visited[vertex] = vertex == START
        robot.told[vertex] = False
        for kind in range(prior.size):
            robot.belief[kind, vertex] = prior[kind]


@compiled
def _empty(world: World) -> None:
    sea = world.sea
    sea.step = 0
    sea.reward = 0.0
    for vertex in range(sea.content.size):
        sea.content[vertex] = NOTHING
        sea.disarmed[vertex] = sea.reported[vertex] = False


@compiled
def _fill(world: World) -> None:
    """Shuffle as many vertices as there are things, the start and the drop-off left out."""
    sea = world.sea
    free = sea.places[DROP_OFF + 1 :]
    for place in range(free.size):
        free[place] = DROP_OFF + 1 + place
    placed = 0
    for kind in range(3):
        for _ in range(world.roadmap.count[kind]):
            other = placed + int(uniform(world, PLACING, placed) * (free.size - placed))
            free[placed], free[other] = free[other], free[placed]
            sea.content[free[placed]] = kind
            placed += 1


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
            status = visit(world, entry.leaf)
            at = entry.follow[status]
            if takes_step(entry.leaf, status) or (at < 0 and idle):
                break
            if at < 0:
                at, idle = 0, True
        robot.entry = at
