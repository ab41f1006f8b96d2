"""`python -m sketchtree` is the program `sketchtree`."""

from sketchtree.commands import main

if __name__ == "__main__":
    main()
