"""Where were the photos taken from? Files of other programs → `Poses`."""
