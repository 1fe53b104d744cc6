"""Studies: runs of a case over parameters and seeds, what they say, and the best setting. See docs/study.md."""
