"""From a mine's logger file to motion.csv and a measured folder. See docs/import.md."""
