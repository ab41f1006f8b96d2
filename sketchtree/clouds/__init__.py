"""Which tree stands in a cloud of points (Guo et al. 2018, §5, and our own way)."""
