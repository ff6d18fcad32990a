"""The simulator, compiled: `episodes` runs robots that act, move, sense and answer conditions.

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
"""
