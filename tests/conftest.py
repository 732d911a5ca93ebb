"""Property tests try the same examples at every run: a failure is of the change, never of the day."""

from hypothesis import settings

settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.load_profile("repeatable")
