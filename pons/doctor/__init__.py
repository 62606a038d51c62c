"""List this machine's lacks for the robot, and how to mend them: ``pons doctor``.

Changes nothing, starts nothing that lasts, and works with or without a running robot.
"""

from pons.doctor.command import run

__all__ = ["run"]
