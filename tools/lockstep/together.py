"""Make things go wrong in a world, and open its eyes. The class that tests and benches use."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sim.site import pose2
from sim.site.objects import LEAF
from tools.lockstep.eyes import PerceptionProcess
from tools.lockstep.metal_world import MetalWorld
from tools.lockstep.truth_detector import TruthFinder

if TYPE_CHECKING:
    from lockstep.disturbance import Disturbance
    from planner.brain.image_questions import Looker
    from tools.lockstep.truth_detector import Finder
    from wire import Pose2


class LockstepWorld(MetalWorld):
    """Be one world. ``world.say(…)`` gives a goal; ``world.run_until(…)`` lets time pass."""

    eyes: PerceptionProcess | None

    def open_eyes(
        self, finder: Finder | None = None, looker: Looker | None = None
    ) -> PerceptionProcess:
        """Let the planner see from now on, by the simulator's truth or by another finder.

        Args:
            finder: finds things in pictures.
            looker: a vision model that is asked about pictures; only where eyes open first.
        """
        if self.eyes is None:
            camera, seed = self.scene.robot.camera, self.seed
            self.eyes = PerceptionProcess(self.scene, finder or TruthFinder(camera, seed))
            self.looker = looker
            self.planner.see_with(self.eyes, looker)
        elif finder is not None:
            self.eyes.look_with(finder)
        return self.eyes

    # What goes wrong ----------------------------------------------------------------------------

    def kill_planner(self) -> None:
        """End the planner at once; what it had said is still on its way."""
        if self._planner is not None:
            self._planner.leave()
        self._planner = None

    def kill_bridge(self) -> None:
        """End the bridge at once; the base is on its own."""
        self.bridge_lives = False

    def freeze_planner(self) -> None:
        """Hold the planner as SIGSTOP does."""
        self._frozen = True

    def thaw_planner(self) -> None:
        """Let the planner go on as SIGCONT does."""
        self._frozen = False

    def silence_localization(self, *, silent: bool = True) -> None:
        """Take the localization's word away, or give it back."""
        self._localizing = not silent

    def disturb(self, disturbance: Disturbance) -> None:
        """Spoil messages from now on."""
        self.bus.disturb(disturbance)

    def calm(self) -> None:
        """Spoil messages no more."""
        self.bus.calm()

    def place_obstacle(self, x_m: float, y_m: float, yaw_rad: float = 0.0) -> None:
        """Stand a person or a crate in the home, in ``map``."""
        self.sim.place_obstacle(x_m, y_m, yaw_rad)

    def remove_obstacle(self) -> None:
        """Take it away again."""
        self.sim.remove_obstacle()

    def put(self, name: str, pose: Pose2 | None) -> None:
        """Put a person or an object of the home somewhere, or take it away."""
        self.sim.place_thing(name, pose)

    def shut_door(self, one: str, other: str, *, shut: bool = True) -> None:
        """Shut the leaf of the door between two rooms, or open it; its own script may go on.

        Raises:
            ConfigError: ``obstacle_unknown``: that door has no leaf; ``Domain(doors=16)`` hangs
                one in each door of the home, and ``door_open_s=0.0`` leaves them to the test.
        """
        between = {one, other}
        doors = enumerate(self.sim.home.doors)
        number = next((at for at, door in doors if set(door.between) == between), -1)
        name = f"{LEAF}{number}"
        declared = self.sim.things.declared.get(name)
        self.sim.place_thing(name, declared if shut else None)

    def stand_on(self, place_id: str, name: str = "person_0") -> None:
        """Put a person, or another thing of the home, onto a place or into a room's middle."""
        home = self.sim.home
        pose = home.rooms[place_id].pose if place_id in home.rooms else home.places[place_id].pose
        self.sim.place_thing(name, pose2(pose))

    def teleport(self, base_in_map: Pose2) -> None:
        """Carry the robot somewhere; its wheels notice nothing."""
        self.sim.place_robot(base_in_map)
