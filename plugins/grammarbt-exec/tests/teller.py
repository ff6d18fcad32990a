"""A simulator that answers every request with the text in a file, whatever that is; `ID` stands for the request's id.

python teller.py FILE
"""

import json
import sys
from pathlib import Path

from stray import ANNOUNCEMENT, say

if __name__ == "__main__":
    say(json.dumps(ANNOUNCEMENT))
    for line in sys.stdin:
        say(Path(sys.argv[1]).read_text(encoding="utf-8").replace("ID", str(json.loads(line)["id"])))
