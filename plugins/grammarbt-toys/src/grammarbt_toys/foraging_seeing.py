"""What a robot of the swarm sees and remembers, compiled."""

from __future__ import annotations

from grammarbt_toys.foraging_world import UNKNOWN, Robot, World
from grammarbt_toys.program import inlined

HUB, SITE, FOOD = range(3)


@inlined
def look(world: World, robot: Robot) -> None:
    """Remember the hub and a site that are in sight; forget a site in sight that is empty."""
    robot.knows_hub = robot.knows_hub != 0 or near(world, robot, HUB, world.sight)
    for site in range(len(world.sites)):
        row, column = world.sites[site, 0], world.sites[site, 1]
        if distance(robot, row, column) <= world.sight:
            if world.food[row, column] > 0:
                robot.site_row, robot.site_column = row, column
            elif robot.site_row == row and robot.site_column == column:
                robot.site_row = robot.site_column = UNKNOWN


@inlined
def distance(robot: Robot, row: int, column: int) -> int:
    """In moves; a diagonal one counts once."""
    return int(max(abs(robot.row - row), abs(robot.column - column)))


@inlined
def where(world: World, robot: Robot, thing: int) -> tuple[int, int]:
    """Where the robot knows the hub, a site, or food: the nearest in sight; among equals the first, row by row."""
    if thing == HUB:
        middle = len(world.food) // 2
        return (middle, middle) if robot.knows_hub != 0 else (UNKNOWN, UNKNOWN)
    if thing == SITE:
        return robot.site_row, robot.site_column
    nearest, at_row, at_column = world.sight + 1, UNKNOWN, UNKNOWN
    for pile in range(world.filled[0]):
        row, column = world.piles[pile, 0], world.piles[pile, 1]
        away = distance(robot, row, column)
        if away < nearest or (away == nearest and (row, column) < (at_row, at_column)):
            nearest, at_row, at_column = away, row, column
    return at_row, at_column


@inlined
def near(world: World, robot: Robot, thing: int, cells: int) -> bool:
    """Whether a thing of that kind, known or not, is at most so many cells away."""
    if thing == HUB:
        return distance(robot, len(world.food) // 2, len(world.food) // 2) <= cells
    if thing == FOOD:
        row, column = where(world, robot, FOOD)
        return row != UNKNOWN and distance(robot, row, column) <= cells
    any_near = False
    for site in range(len(world.sites)):
        any_near = any_near or distance(robot, world.sites[site, 0], world.sites[site, 1]) <= cells
    return any_near
