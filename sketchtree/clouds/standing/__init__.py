"""Where does the plant stand, on how many stems, and how thick is its trunk?"""
