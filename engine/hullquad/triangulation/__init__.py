"""From the edges of a plate to triangles."""
