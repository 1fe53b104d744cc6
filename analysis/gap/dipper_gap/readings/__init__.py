"""What was measured, or would have been: its passes, phases and features, and how its instruments err."""
