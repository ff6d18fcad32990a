"""The platform game again, in readable plain Python, with drawings of what happens."""

from toys_reference import answer_of

from grammarbt.bt import Action, Status, flatten, leaves, tick


class PlainGame:
    """A level given as a row of signs: `_` level ground, a blank a gap, 1 and 2 walls, `e` an enemy."""

    def __init__(self, level):
        self.ground = [int(sign) if sign in "12" else {" ": None}.get(sign, 0) for sign in level]
        self.enemies = [[column, -1] for column, sign in enumerate(level) if sign == "e"]
        self.x, self.y, self.rising, self.facing, self.reloading, self.alive = 0, 0, 0, 1, 0, True
        self.step, self.farthest, self.pressed = 0, 0, set()

    def play(self, tree, steps):
        """How often each leaf was ticked."""
        ticks = [0] * len(leaves(tree))
        while self.alive and self.step < steps and self.farthest < len(self.ground) - 1:
            self.pass_step(tree, ticks)
        return ticks

    def pass_step(self, tree, ticks):
        self.pressed.clear()
        self.step += 1

        def answer(leaf, occurrence):
            ticks[occurrence] += 1
            if isinstance(leaf, Action):
                self.pressed.add(leaf.name)
                return Status.SUCCESS
            cell = {key: int(value) for key, value in leaf.arguments}
            return answer_of(getattr(self, leaf.name.replace(" ", "_"))(**cell))

        tick(flatten(tree), answer)
        self.rise_or_fall()
        self.go()
        self.shoot()
        self.walk()
        self.farthest = max(self.farthest, self.x)

    def solid(self, right, up):
        x, y = self.x + right, self.y + up
        if not 0 <= x < len(self.ground):
            return x < 0
        return self.ground[x] is not None and y < self.ground[x]

    def enemy(self, right, up):
        return self.y + up == 0 and any(enemy[0] == self.x + right for enemy in self.enemies)

    def on_ground(self):
        return self.solid(0, -1)

    def can_shoot(self):
        return self.reloading == 0

    def beat(self, right):
        """Only the first of several enemies in one cell is beaten."""
        if self.enemy(right, 0):
            self.enemies.remove(next(enemy for enemy in self.enemies if enemy[0] == self.x + right))

    def rise_or_fall(self):
        on_ground = self.on_ground()
        if "jump" in self.pressed and on_ground:
            self.rising = 2
        if self.rising:
            self.rising -= 1
            self.y += 1
        elif not on_ground:
            self.y -= 1
            self.beat(0)

    def go(self):
        direction = ("right" in self.pressed) - ("left" in self.pressed)
        self.facing = direction or self.facing
        for _ in range(2 if "run" in self.pressed else 1):
            if self.alive and not self.solid(direction, 0) and self.x + direction < len(self.ground):
                self.x += direction
            self.alive = self.alive and not self.enemy(0, 0)
        self.alive = self.alive and self.y >= 0

    def shoot(self):
        self.reloading = max(0, self.reloading - 1)
        if "shoot" not in self.pressed or self.reloading:
            return
        self.reloading = 6
        for right in range(self.facing, 7 * self.facing, self.facing):
            if self.enemy(right, 0):
                self.beat(right)
                return
            if self.solid(right, 0):
                return

    def walk(self):
        if self.step % 2 == 0:
            for enemy in self.enemies:
                ahead = enemy[0] + enemy[1]
                if 0 <= ahead < len(self.ground) and self.ground[ahead] == 0:
                    enemy[0] = ahead
                else:
                    enemy[1] *= -1
        self.alive = self.alive and not self.enemy(0, 0)

    def drawing(self):
        """The rows from the top: the player P, or X when it is out, enemies e, ground and walls #."""
        rows = [["#" if ground is not None and y < ground else "." for ground in self.ground] for y in range(3, -2, -1)]
        for column, _ in self.enemies:
            rows[3][column] = "e"
        rows[3 - self.y][self.x] = "P" if self.alive else "X"
        return ["".join(row) for row in rows]
