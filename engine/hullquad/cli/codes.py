"""Exit codes of the commands; 130, interrupted, is in `interrupt`."""

DONE = 0
REFUSED = 1
USAGE = 2
VIOLATED = 3
"""Elements are as bad as was asked for with ``--fail-on``."""
