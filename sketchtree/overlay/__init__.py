"""What did the reader make of a drawing? A picture to check it by: strokes, junctions, root, crown, doubts (PNG or SVG)."""
