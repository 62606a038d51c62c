"""See in lockstep with drawn pictures and a real detector."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.object_names import canonical
from planner.perception.detect import ModelOptions, OnnxDetector
from planner.perception.process_client import DEFAULT_MODEL
from sim.camera import SimCamera
from wire import SimScene

if TYPE_CHECKING:
    from pathlib import Path

    from planner.perception.snapshot import Detection
    from sim import SimRobot
    from wire import CameraConfig, ImageHeader


class DrawnFinder:
    """Draw each picture, pack it as the camera does, and have a model look at it."""

    def __init__(self, sim: SimRobot, camera: CameraConfig, model: Path = DEFAULT_MODEL) -> None:
        """Build the camera of one home.

        Raises:
            VisionFailure: the model is refused.
        """
        self._camera = SimCamera(sim.home, camera, seed=1)
        self._detector = OnnxDetector(ModelOptions(model))

    @property
    def classes(self) -> tuple[str, ...]:
        """Return what the model knows, as the planner calls it."""
        return tuple(canonical(name) for name in self._detector.about.classes if name)

    def find(self, sim: SimRobot, header: ImageHeader) -> tuple[Detection, ...]:
        """Return what is found in a picture taken now."""
        scene = SimScene(
            boot_id=header.boot_id,
            seq=header.seq,
            stamp_s=header.stamp_s,
            base_in_map=sim.base_in_map,
            things=sim.things.elsewhere,
        )
        shot = self._camera.take(scene, header.stamp_s)
        if shot is None:
            return ()
        size = (header.width, header.height)
        return self._detector.look(shot.color, shot.depth, size, header.focal_px).detections
