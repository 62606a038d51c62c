"""Hold the Chinese patterns of the grammar."""
