"""What a library writes to standard output by itself, past Python."""

from __future__ import annotations

import os
import sys
import tempfile
from typing import Self


class Console:
    """The process's standard output, caught in a file while this is open."""

    def __enter__(self) -> Self:
        """Begin to catch."""
        sys.stdout.flush()
        self.file = tempfile.TemporaryFile()
        self.saved = os.dup(1)
        os.dup2(self.file.fileno(), 1)
        return self

    def __exit__(self, *_: object) -> None:
        """Let go."""
        os.dup2(self.saved, 1)
        os.close(self.saved)
        self.file.close()

    def read(self) -> bytes:
        """What has been written since the last time."""
        descriptor = self.file.fileno()
        data = os.pread(descriptor, os.lseek(descriptor, 0, os.SEEK_CUR), 0)
        os.ftruncate(descriptor, 0)
        os.lseek(descriptor, 0, os.SEEK_SET)
        return data
