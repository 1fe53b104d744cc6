"""Chance and explanation: the seeds' spread, the tests, the signatures of effects and their match."""
