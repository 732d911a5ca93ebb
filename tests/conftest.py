"""What all tests rely on: the same examples at every run, and an interrupt that arrives.

Property tests repeat themselves exactly: a failure is of the change, never of the day. A test run that was started
in the background of a shell ignores Ctrl+C, and so would every program that it starts to interrupt it.
"""

import signal

from hypothesis import settings

settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.load_profile("repeatable")
signal.signal(signal.SIGINT, signal.default_int_handler)
