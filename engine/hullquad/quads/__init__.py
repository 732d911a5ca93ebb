"""From triangles to quads: pairs of neighbours, the paper's front, and better pairings."""
