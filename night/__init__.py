"""The night: every metric and every cost of every run in one file, what stepped and since which commit, and a summary for the
morning."""
