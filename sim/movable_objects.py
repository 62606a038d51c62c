"""Hold the poses of a home's movable things. Knows no physics.

What nobody moved stands as the home declares; only the rest is worth telling.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sim.site.classes import SPARE_OBSTACLES
from sim.site.objects import is_movable, pose_of
from wire import ConfigError, Pose2, SimThing

if TYPE_CHECKING:
    from sim.site import Home


class Things:
    """Hold people, objects and spare obstacles by name."""

    def __init__(self, home: Home) -> None:
        self.declared: dict[str, Pose2 | None] = {
            **dict.fromkeys(SPARE_OBSTACLES),
            **{who: pose_of(one.at, one.yaw) for who, one in home.people.items()},
            **{
                name: pose_of(item.at, item.yaw)
                for name, item in home.objects.items()
                if is_movable(name, item)
            },
        }
        """Where each stands at first; None is nowhere."""
        spare = (name for name in SPARE_OBSTACLES if name.startswith("person"))
        self.people = (*spare, *home.people)
        self._now = dict(self.declared)
        self.elsewhere: tuple[SimThing, ...] = ()
        """Those that are not where the home declares them."""

    def pose_of(self, name: str) -> Pose2 | None:
        """Return a thing's pose now; None where it is nowhere."""
        self._check(name)
        return self._now[name]

    def move(self, name: str, pose: Pose2 | None) -> None:
        """Put a thing down somewhere, or take it away.

        Raises:
            ConfigError: ``obstacle_unknown``; the text lists what there is.
        """
        self._check(name)
        self._now[name] = pose
        self.elsewhere = tuple(
            SimThing(name=thing, pose=at)
            for thing, at in self._now.items()
            if at != self.declared[thing]
        )

    def _check(self, name: str) -> None:
        if name not in self.declared:
            known = ", ".join(self.declared)
            raise ConfigError("obstacle_unknown", f"no thing {name!r}; there are: {known}")
