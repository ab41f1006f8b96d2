"""How leafy is a scan? Which points are wood and which are leaves, what bears those, and how many leaves the tree is to wear where."""
