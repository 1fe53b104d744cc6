"""What was measured, or would have been: passes, phases, features, and the instruments' errors."""
