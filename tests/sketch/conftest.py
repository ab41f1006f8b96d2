"""Lets the folders of this room import the drawings and hands they share (`hands.py`)."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
