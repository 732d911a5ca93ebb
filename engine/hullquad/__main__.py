"""``python -m hullquad``: the engine's commands, without the window."""

import sys

from hullquad.cli import main

if __name__ == "__main__":
    sys.exit(main())
