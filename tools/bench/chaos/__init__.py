"""Break a whole robot under ``pons up`` at random, be its person, and judge it from outside.

``draw`` decides everything about an episode from its number; ``house`` runs the processes;
``faults`` break and mend; ``witness`` hears truth, status and speech; ``person`` brings the robot
back; ``verdict`` judges what was heard. ``tools.bench.measure.chaos`` counts.
"""
