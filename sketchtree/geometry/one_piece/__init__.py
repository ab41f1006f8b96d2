"""Wood as one closed surface: every limb's tube is stitched into its parent's."""
