"""Figures of the report: each function takes data of a result and gives an SVG as text, the same bytes for the same data."""
