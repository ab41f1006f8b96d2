"""Do the programs people use open our files, and see in them what we put in?"""
