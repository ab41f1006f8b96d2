"""Which strokes does this file hold? One reader a format, each to a `Sketch`; and writers back."""
