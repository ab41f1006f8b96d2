"""Which strokes does a picture of a line drawing hold? Ink, skeleton, traces, widths."""
