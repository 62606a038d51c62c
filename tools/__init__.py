"""Hold what is not run on a robot: benches, attacks, training and the lockstep harness."""
