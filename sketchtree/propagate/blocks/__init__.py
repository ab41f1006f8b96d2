"""Which piece of a tree can be replicated, which one where, and how does it look there? (Chen §6)"""
