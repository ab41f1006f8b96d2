"""Where do the points of a plant lie that several photos show (Guo et al. 2018, §4)? Photos → cameras → depth maps → a cloud."""
