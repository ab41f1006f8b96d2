"""What has been done to a drawing and its tree by hand, and how the tree follows.

    document   the drawing, what was done to the tree by hand, and the options: all that a project keeps
    edits      a limb's depth held, an undrawn limb cleared away or adopted
    settled    the depths that every drawn limb has come to, by limb id, so that only what was touched is solved again
"""
