"""Decide which mode the robot is in, and how it enters and leaves it."""
