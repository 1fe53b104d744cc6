"""Chance and explanation: the seeds' spread, tests, the signatures of effects and their match."""
