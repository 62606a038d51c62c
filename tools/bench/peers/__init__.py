"""Hold the contenders of the comparison: scripts that run alone, each in the Python that has it."""
