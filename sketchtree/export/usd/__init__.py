"""Trees as USD."""
