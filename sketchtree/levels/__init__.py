"""The same tree with fewer triangles: levels of detail, and a picture of it on a few cards."""
