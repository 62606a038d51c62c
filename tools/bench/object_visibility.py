"""Tell whether a thing of a drawn home shows in any picture that its robot could take.

Homes are drawn without looking: what is put onto a sofa may lie inside its arm, and nobody would
ask a robot for it.
"""

from __future__ import annotations

from math import atan2, hypot
from typing import TYPE_CHECKING

import numpy as np

from sim.camera import Appearance, Renderer
from tools.train.views import Views
from wire import Pose2

if TYPE_CHECKING:
    from collections.abc import Collection
    from random import Random

    from sim.site import Home
    from wire import CameraConfig

LEAST_PX = 20
"""Of a picture: half of what a cup covers at 4 m."""
FAR_M = 6.0
POSES = 300


def in_sight(
    home: Home, names: Collection[str], camera: CameraConfig, random: Random, poses: int = POSES
) -> bool:
    """Tell whether one of a home's objects shows from one of many drawn poses, looked at."""
    renderer, views = Renderer(home, camera, Appearance()), Views(home)
    wanted = [number for number, (name, _) in renderer.labels.items() if name in names]
    spots = [home.objects[name].at for name in names]
    for _ in range(poses):
        pose, at = views.draw_pose(random), random.choice(spots)
        ahead_m, left_m = at[0] - pose.x_m, at[1] - pose.y_m
        if hypot(ahead_m, left_m) > FAR_M:
            continue
        seen = renderer.render(Pose2(pose.x_m, pose.y_m, atan2(left_m, ahead_m)))
        if np.isin(seen.ids, wanted).sum() >= LEAST_PX:
            return True
    return False
