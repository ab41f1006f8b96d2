"""Lets the files of this folder import the pictures they share (`sheets.py`)."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
