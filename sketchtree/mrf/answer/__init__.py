"""From samples to what is shown: typical depths, other readings, spread; nothing passes through anything."""
