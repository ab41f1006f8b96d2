"""What becomes of a grown tree? Stages that take a complete skeleton and return one."""
