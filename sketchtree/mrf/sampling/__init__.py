"""Where may the chains of the default method go, and how do they get there?"""
