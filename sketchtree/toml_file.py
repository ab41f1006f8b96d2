"""What does a TOML file that people may edit say?"""

import tomllib
from pathlib import Path

from sketchtree.errors import TemplateError


def read_table(path: Path, what: str) -> dict:
    """The file's table. `what`: what it is called when it is at fault. Raises TemplateError."""
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise TemplateError(f"{what} {path.name}: it can't be read ({error}).", remedy="Give a readable TOML file.") from error
