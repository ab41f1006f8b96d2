"""How good and how fast? Each module here is run by one command: `python -m benchmarks.depth`."""
