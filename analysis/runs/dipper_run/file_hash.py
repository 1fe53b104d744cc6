"""The hash that says whether a file is as it was written."""
import hashlib


def sha256_of(file):
    with open(file, "rb") as f:
        return hashlib.file_digest(f, "sha256").hexdigest()
