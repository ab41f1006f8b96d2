"""Which limbs show in the photo, from a stroke along each (Tan et al. 2008, §2)?"""
