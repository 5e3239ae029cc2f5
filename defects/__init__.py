"""Planted defects: what the matrix would catch. Each is a patch with a wrong that a person makes or the paper prints."""
