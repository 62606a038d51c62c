"""Play a base's firmware at the far end of a serial line, with the simulated robot as its body."""

from sim.twin.twin import FIRMWARES, DriveTwin

__all__ = ["FIRMWARES", "DriveTwin"]
