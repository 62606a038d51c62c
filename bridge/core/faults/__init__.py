"""Detect faults, latch them, and list all of them in one table."""
