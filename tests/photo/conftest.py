"""Tests of all photo rooms paint their pictures with `painted`."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
