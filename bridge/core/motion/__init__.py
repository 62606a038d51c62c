"""Turn a path into the one speed command that the robot may drive."""
