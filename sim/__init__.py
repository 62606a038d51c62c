"""Stand in for a robot and a home that are not there. Imports wire only."""
