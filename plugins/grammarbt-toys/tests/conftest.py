"""Where the tests find what they share."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parent))  # test folders are no packages; toys_trees is found this way
