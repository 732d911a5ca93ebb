"""One module per dock of the window."""
