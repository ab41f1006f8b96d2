"""What was drawn? A file → `Sketch` (files, raster) → what each stroke is (roles) → what grows from what (joining) → `SketchGraph`."""
