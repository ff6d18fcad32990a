"""The simulator, compiled: `episodes` runs the robot, whose leaves act on the cubes and itself and answer conditions.

An action node takes at least two ticks: in the first it begins and is RUNNING, in the next it acts, and the answer it
then gives it keeps giving. It begins again when it was not RUNNING in the tick before and its effect does not hold. Head
up counts as in effect while the arm is at work, head down while a move is: else a tree that raises the head to drive
and lowers it to pick would do nothing but nod. At work means begun and not yet done, also when interrupted.

Where the published definition leaves a choice: A robot that drops its cube or loses its way on a move stops half-way
between where it believed to be and where it was going; it may lose its way without a cube too. A cube can only be put on
its goal: to put it back on a pick table takes a tucked arm, and tucking loses the cube.
"""
