"""Where are the exemplars kept? Columns, the file, how it is written, checked and brought up to date."""
