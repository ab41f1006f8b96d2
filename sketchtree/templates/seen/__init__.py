"""What is seen of a tree from one side, or of a sketch? Footprint, branching, posture, and a thumbnail."""
