"""What each leaf, tuft and blossom looks like, as code."""
