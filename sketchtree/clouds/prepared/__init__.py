"""What has to be done to points before a tree is looked for in them?"""
