"""Where the tests find the plain worlds to compare with."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parent))  # test folders are no packages; toys_reference is found this way
