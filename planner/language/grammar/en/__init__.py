"""Hold the English patterns of the grammar."""
