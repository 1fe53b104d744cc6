"""Finds, names, adds and confirms an effect that the simulation misses. See docs/gap.md."""
