"""What several test files need."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parent))  # test folders are no packages; gymnasium_worlds is found this way
