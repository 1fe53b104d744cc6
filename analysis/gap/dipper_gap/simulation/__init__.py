"""The runs of the case: the effects they may have, which are needed, and how they are made."""
