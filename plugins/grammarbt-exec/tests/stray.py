"""A simulator with one fault; the return of a scenario is its number.

python stray.py FAULT [MARK [EVERY]]: shows the fault at its second request, or at all whose id EVERY divides. With a
file MARK it has a child, and adds a line with the numbers of both processes to the file.
"""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

ANNOUNCEMENT = {
    "protocol": 1,
    "episodes": True,
    "groups": [
        {
            "name": "g",
            "actions": ["stay", {"name": "go", "parameters": {"to": ["home", "work"]}, "results": ["running"]}],
            "conditions": ["far", {"name": "near", "pure": True, "help": "within a step"}],
        }
    ],
    "references": [{"name": "manual", "tree": "?( (near) [stay] )"}],
}


def say(text, end="\n"):
    sys.stdout.write(text + end)
    sys.stdout.flush()


def raw(data):
    sys.stdout.buffer.write(data)
    sys.stdout.buffer.flush()


def die():
    sys.stderr.write("first sign\nlast words\n")
    sys.stderr.flush()
    os._exit(3)


def answer(request, **changes):
    if "episode" in request:
        frame = {"answers": tick(request), "reward": request["episode"]}
        return json.dumps({"id": request["id"], "frames": [frame]} | changes)
    fine = {"id": request["id"], "returns": [float(number) for number in request["scenarios"]]}
    return json.dumps(fine | changes)


def tick(request):
    """No condition holds, and no action ends."""
    at, answers = 0, []
    while at >= 0:
        _, occurrence, _, on_failure, on_running = request["policy"][5 * at : 5 * at + 5]
        condition = request["leaves"][occurrence].startswith("(")
        answers.append((occurrence, "failure" if condition else "running"))
        at = on_failure if condition else on_running
    return answers


FAULTS = {
    "dies": lambda _: die(),
    "crashes": lambda _: os.kill(os.getpid(), signal.SIGSEGV),
    "hangs": lambda _: time.sleep(600),
    "dribbles": lambda _: [(say(".", end=""), time.sleep(0.01)) for _ in range(10_000)],
    "floods": lambda _: [sys.stderr.write("flood\n") for _ in range(10_000_000)],
    "partial": lambda request: (say(answer(request)[:12], end=""), time.sleep(600)),
    "halves": lambda request: (say(answer(request)[:12], end=""), time.sleep(0.1), say(answer(request)[12:])),
    "closes": lambda _: (os.close(1), time.sleep(600)),
    "garbage": lambda _: say("Segmentation fault (not really)"),
    "no object": lambda _: say("[1,2,3]"),
    "wrong id": lambda request: say(answer(request, id=request["id"] + 1)),
    "no id": lambda request: say(json.dumps({"returns": [0] * len(request["scenarios"])})),
    "too few": lambda request: say(answer(request, returns=[1.0])),
    "texts": lambda request: say(answer(request, returns=["1", "2", "3"])),
    "nan": lambda request: say(answer(request, returns=[1.0, float("nan"), 2.0])),
    "infinite": lambda request: say(answer(request, returns=[1.0, 10**400, 2.0])),
    "wrong ticks": lambda request: say(answer(request, ticks=[1])),
    "half ticks": lambda request: say(answer(request, ticks=[1, 0.5, 1])),
    "two lines": lambda request: say(answer(request) + "\nand another thing"),
    "latin": lambda _: raw("d\xe9j\xe0 vu\n".encode("latin-1")),
    "deep": lambda _: say("[" * 200_000),
    "huge": lambda _: (say("x" * 17 * 2**20), time.sleep(600)),
    "silent": lambda request: say(answer(request)),
    "chatty": lambda request: (sys.stderr.write("log\n" * 100_000), say(answer(request))),
    "half a letter": lambda request: say(json.dumps({"id": request["id"], "error": "\ud800"})),
    "refuses": lambda request: say(json.dumps({"id": request["id"], "error": "no such robot"})),
}


def main(fault, mark="-", every="0"):
    announcement = ANNOUNCEMENT | {"episodes": fault != "silent"}
    if fault == "changes" and Path(mark).exists():
        announcement |= {"grammar": "scheide"}
    if mark != "-":
        child = subprocess.Popen(["sleep", "600"])  # noqa: S607 - any program that stays will do
        with Path(mark).open("a") as file:
            file.write(f"{os.getpid()} {child.pid}\n")
    say(json.dumps(announcement))
    for number, line in enumerate(sys.stdin):
        request = json.loads(line)
        due = request["id"] % int(every) == 0 if int(every) else number == 1
        if due and fault != "none":
            FAULTS.get(fault, lambda _: die())(request)
        else:
            say(answer(request))


if __name__ == "__main__":
    main(sys.argv[1].replace("-", " "), *sys.argv[2:])
