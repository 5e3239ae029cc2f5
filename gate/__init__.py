"""The gate: compares a run with the accepted baselines, says what moved and where to, and records what is accepted and why."""
