"""What is a stroke called? Names from files made printable, and unique in their sketch."""


def unique(name: str, used: dict[str, int]) -> str:
    """`name`, or `name-2`, `name-3` … if it is taken. Half a surrogate pair, which can't be printed, becomes "?".

    `used` holds every name that is taken, and the last number that was put behind it (1: none).
    """
    name = name.encode("utf-8", "replace").decode()
    free, k = name, used.get(name, 1)
    while free in used:
        k += 1
        free = f"{name}-{k}"
    used[name] = k
    used[free] = used.get(free, 1)
    return free
