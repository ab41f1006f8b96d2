"""The program itself, with a page in which there is nothing: `python pageless.py PAGE studio …`."""

import sys
from pathlib import Path

if __name__ == "__main__":
    from sketchtree.commands import main
    from sketchtree.studio import built

    page = Path(sys.argv.pop(1))
    built.page_folder = lambda: page
    main()
