"""What is a stroke called? Names from files made printable, and unique in their sketch."""


def unique(name: str, used: set[str]) -> str:
    """`name`, or `name-2`, `name-3` … if it is taken; entered in `used`. Half a surrogate pair, which can't be printed, becomes "?"."""
    name = name.encode("utf-8", "replace").decode()
    free, k = name, 1
    while free in used:
        k += 1
        free = f"{name}-{k}"
    used.add(free)
    return free
