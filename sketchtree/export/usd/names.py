"""Names as USD allows them: letters, digits and `_`, not a digit first, no two alike under one prim."""

import re


def prim_name(name: str, taken: set[str]) -> str:
    """The name as USD takes it, with a number where it is taken; it is taken then."""
    plain = re.sub(r"[^A-Za-z0-9_]", "_", name) or "part"
    plain = plain if not plain[0].isdigit() else f"_{plain}"
    chosen, count = plain, 1
    while chosen in taken:
        count += 1
        chosen = f"{plain}_{count}"
    taken.add(chosen)
    return chosen
