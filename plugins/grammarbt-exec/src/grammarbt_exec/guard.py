"""Runs a program, and ends all that it has started when it ends, or when whoever wanted it goes away, however that is.

A process that is killed cannot clean up. So the program's own parent is this small one, which holds one end of a socket
whose other end is the worker process's alone: when the worker is gone, the socket says so. Guard and program form a
process group of their own, which also keeps Ctrl-C in a terminal from the program.

    python guard.py DESCRIPTOR COMMAND [ARGUMENT]…

The last thing it says through the socket is how the program ended: its exit code, or minus its signal.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from select import select

GRACE = 1.0
"""Seconds that a program whose standard input has ended gets to end by itself."""

NOT_STARTED = 127


def main(lifeline: int, command: list[str]) -> None:
    """Run until the program or the lifeline ends; does not return."""
    code = _code(lifeline, command)
    with contextlib.suppress(OSError):
        os.write(lifeline, str(code).encode())
    os.killpg(0, signal.SIGKILL)


def _code(lifeline: int, command: list[str]) -> int | None:
    wake, notify = os.pipe()
    os.set_blocking(notify, False)
    signal.set_wakeup_fd(notify)
    signal.signal(signal.SIGCHLD, lambda *_: None)
    try:
        program = subprocess.Popen(command)  # noqa: S603 - the command is what the user asked for
    except OSError as error:
        os.write(sys.stderr.fileno(), str(error.strerror).encode())
        return NOT_STARTED
    _let_go_of_the_streams()
    while program.poll() is None:
        if lifeline in select([lifeline, wake], [], [])[0]:
            with contextlib.suppress(subprocess.TimeoutExpired):
                program.wait(GRACE)
            break
        os.read(wake, 4096)
    return program.returncode


def _let_go_of_the_streams() -> None:
    """Only the program holds them, so that the worker sees their end when the program closes them."""
    nothing = os.open(os.devnull, os.O_RDWR)
    for stream in range(3):
        os.dup2(nothing, stream)


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2:])
