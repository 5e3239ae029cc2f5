"""The report of a run: one folder of pages and figures, made from result files only."""
