"""What is learned in Gymnasium's environments? A row per seed, then how many reach the goal.

    python benchmarks/gymnasium_learning.py CartPole-v1 --goal 490
    python benchmarks/gymnasium_learning.py MountainCar-v0 --goal -110 --seeds 100 110 --workers 2
    python benchmarks/gymnasium_learning.py --speed

Each value is the mean of 100 fresh episodes. Seeds 0–9 are for tuning; claims rest on others.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np

from grammarbt.bt import compile_policy, leaves, parse
from grammarbt_gymnasium.domain import GymnasiumDomain
from grammarbt_gymnasium.parameters import GymnasiumParameters

SPEED_OF = ("CartPole-v1", "MountainCar-v0", "Acrobot-v1")
SPEED_EPISODES = 50


def run(seed: int, env: str, budget: int, options: list[str]) -> dict[str, object]:
    """The JSON of one run in a process of its own."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "grammarbt", "run", "--quiet", "--json", "--seed", str(seed)]
        command += ["--domain", "gymnasium", "--set", f"domain.env={env}", "--searcher", "dagmcts"]
        command += ["--budget", str(budget), "--validation", "100", "--out", str(Path(folder) / "run"), *options]
        result: dict[str, object] = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    return result


def learning(arguments: argparse.Namespace, options: list[str]) -> None:
    """Run every seed and print what came of it."""
    once = partial(run, env=arguments.env, budget=arguments.budget, options=options)
    print("seed     value  stderr  leaves  episodes  tree")
    values = []
    with ThreadPoolExecutor(arguments.workers) as pool:
        for seed, found in zip(range(*arguments.seeds), pool.map(once, range(*arguments.seeds)), strict=True):
            tree = str(found["tree"])
            row = f"{found['value']:8.1f}  {found['stderr']:6.1f}  {len(leaves(parse(tree))):6}  {found['episodes']:8}"
            print(f"{seed:4}  {row}  {tree}", flush=True)
            values.append(found["value"])
    print(f"{arguments.env}: mean {np.mean(values):.1f}, worst {np.min(values):.1f}")
    if arguments.goal is not None:
        reached = sum(value >= arguments.goal for value in values)
        print(f"{reached} of {len(values)} seeds reach {arguments.goal} with {arguments.budget} episodes")


def speed() -> None:
    """Episodes and steps of the trees written by hand, per second of processor time; a step is a tick."""
    print("environment     episodes/s  steps/s  steps/s of the environment alone")
    for env in SPEED_OF:
        domain = GymnasiumDomain(GymnasiumParameters(env=env))
        policy = compile_policy(parse(domain.references[0].tree), domain.vocabulary.index)
        start = time.process_time()
        returns = domain.simulate(policy, np.arange(SPEED_EPISODES)).returns
        spent = time.process_time() - start
        steps = np.abs(returns).sum()  # in these three, each step pays 1 or costs 1
        alone = steps_alone(domain, int(steps))
        print(f"{env:14}  {SPEED_EPISODES / spent:10.0f}  {steps / spent:7.0f}  {alone:7.0f}", flush=True)


def steps_alone(domain: GymnasiumDomain, steps: int) -> float:
    """Steps per second of processor time when nobody decides anything."""
    env = domain.environment.env
    env.reset(seed=0)
    start = time.process_time()
    for step in range(steps):
        _, _, terminated, _, _ = env.step(step % 2)
        if terminated:
            env.reset(seed=step)
    return steps / (time.process_time() - start)


def main() -> None:
    """Print the table asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("env", nargs="?", default="CartPole-v1")
    parser.add_argument("--goal", type=float)
    parser.add_argument("--budget", type=int, default=20_000)
    parser.add_argument("--seeds", type=int, nargs=2, default=[100, 110], metavar=("FIRST", "END"))
    parser.add_argument("--workers", type=int, default=1, help="runs side by side")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--speed", action="store_true", help="measure episodes per second instead")
    arguments = parser.parse_args()
    if arguments.speed:
        speed()
    else:
        learning(arguments, [word for setting in arguments.set for word in ("--set", setting)])


if __name__ == "__main__":
    main()
