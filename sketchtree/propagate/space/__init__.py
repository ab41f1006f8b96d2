"""Where may the tree grow? The crown, what stands in the way, neighbours, light."""
