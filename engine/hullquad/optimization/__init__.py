"""Moving the nodes: every optimiser is a generator of iterates that the caller may stop pulling from."""
