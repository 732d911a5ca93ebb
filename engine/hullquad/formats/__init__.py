"""Files in and out: a table of formats by suffix."""
