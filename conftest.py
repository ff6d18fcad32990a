"""What holds for all tests, of the core and of the plugins."""

import signal


def pytest_configure() -> None:
    """Let tests send Ctrl-C: a shell starts what runs in its background deaf to it, and children inherit that."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
