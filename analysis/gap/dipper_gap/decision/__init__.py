"""What may be said, whether it holds, and what follows: the patched case, the next experiment."""
