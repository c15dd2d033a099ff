"""Pictures for these tests are made by the generator beside the tests of what students hand in."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parent))
