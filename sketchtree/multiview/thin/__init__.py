"""Wood that is too thin for depth maps, as photos show it: faint lines, followed from wood that is known."""
