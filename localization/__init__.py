"""Say where the robot is. Imports wire only."""
