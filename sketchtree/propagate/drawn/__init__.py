"""What of the drawing may grow on? Its ends and nodes, leaders into an empty crown, limbs for empty sides."""
