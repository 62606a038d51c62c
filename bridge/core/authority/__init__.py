"""Hold the right to move the robot, how far and how long: owner, grants, legs, epoch."""
