"""The file that the robot tutorial gives to Nav2 is read by BehaviorTree.CPP, and its tree is ticked on and on."""

from behaviortreepy import BehaviorTreeFactory, NodeStatus
from pages import ROOT, blocks


def test_the_tree_for_nav2_runs_until_it_is_cancelled_and_does_the_task():
    page = (ROOT / "docs/tutorials/robot.md").read_text(encoding="utf-8")
    files = {block.name: block.text for block in blocks(page)}
    module = {}
    exec(files["robot.py"], module)  # noqa: S102 - it is what the reader writes
    robot = module["Robot"]()
    factory = BehaviorTreeFactory()
    for tag in ("go_to_cup", "go_to_door", "grasp"):
        factory.register_simple_stateful_action(
            tag,
            lambda node: NodeStatus.__members__[robot.action(node.name())],
            lambda node: NodeStatus.__members__[robot.action(node.name())],
            lambda node: robot.halt(node.name()),
        )
    factory.register_simple_condition(
        "holding_cup", lambda _: NodeStatus.SUCCESS if robot.condition("holding cup") else NodeStatus.FAILURE
    )
    tree = factory.create_tree_from_text(files["cup_nav2.xml"])
    assert {tree.tick_exactly_once() for _ in range(12)} == {NodeStatus.RUNNING}
    assert robot.done
