"""How is the database made from its recipes? Orders, who works on them, what is kept of an unfinished run."""
