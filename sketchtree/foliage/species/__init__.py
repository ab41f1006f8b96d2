"""What each species wears: which drawing, in which colours, of which size and posture."""
