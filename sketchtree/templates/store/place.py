"""Which file is the database, where none is named? Light to import: who only asks which file it is reads nothing of it."""

import os
from pathlib import Path

ENVIRONMENT = "SKETCHTREE_DB"


def default_path() -> Path:
    """$SKETCHTREE_DB, else the file in the package, else `template_db/exemplars.h5` of a checkout."""
    if os.environ.get(ENVIRONMENT):
        return Path(os.environ[ENVIRONMENT])
    here = Path(__file__).resolve()
    packaged = here.parents[1] / "data" / "exemplars.h5"
    return packaged if packaged.exists() else here.parents[3] / "template_db" / "exemplars.h5"
