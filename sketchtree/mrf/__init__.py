"""How deep is each drawn segment? A factor graph over depths, and the solvers that read them off it."""
