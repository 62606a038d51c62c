"""Hold who may move the robot, how far and how long: owner, grants, legs, epoch."""
