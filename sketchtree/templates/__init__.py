"""Trees that a sketch may be like: grown from recipes or imported, kept in a database, matched with what was drawn."""
