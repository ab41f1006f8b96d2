"""The processes that make trees for the studio.

    worker     one process: jobs in, outcomes out
    work       one job: a document becomes a tree, in full, in a hurry, or not kept at all
    chunks     a tree → what grows on each drawn limb, as arrays            frames   arrays → bytes
    limb_table what the page knows of each drawn limb                       ghosts   the stroke in hand, in space
    textures   pictures of materials                                        gallery  what there is to choose from, with thumbnails
"""
