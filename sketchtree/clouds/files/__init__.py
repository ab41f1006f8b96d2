"""Which points are in this file?"""
