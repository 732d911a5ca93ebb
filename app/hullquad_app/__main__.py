"""`python -m hullquad_app` is the command `hullquad`."""

import sys

from hullquad_app.main import main

if __name__ == "__main__":
    sys.exit(main())
