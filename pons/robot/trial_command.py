"""Try a robot of metal from a terminal, wheels off the ground: ``pons robot try``.

Takes the base's own port, so nothing else may drive it meanwhile; the motors turn slowly, for about
half a minute in all, and stop when this program does. The page does the same (setup_node.py).
"""

from __future__ import annotations

import logging
import select
import sys
from typing import TYPE_CHECKING

from pons.calibrate.errors import CalibrationRefusal
from pons.robot.trial_parties import TrialRefusal
from pons.robot.trial_run import load_triable, refusal_of, require_base, try_robot, wait_for
from pons.robot.trial_words import PROMPTS, REFUSALS, STEPS
from pons.terminal import pick
from wire import ConfigError

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

EXIT_PROVED, EXIT_REFUSED, EXIT_INTERRUPTED = 0, 3, 130
LIFTED = "UP"
LIFT = "wheels_up"
_DONE = ", then Enter", "，然后回车"
_LIFTED = "; type UP, then Enter", "。输入 UP 后回车"


def run_trial(settings: LaunchSettings) -> int:
    """Try the robot; 0 proved and written, 3 refused, 130 interrupted."""
    logging.getLogger().addHandler(logging.NullHandler())  # else drivers' logs stand in a question
    try:
        robot = load_triable(settings.robot)
        require_base(settings.robot, robot)
        person = TerminalPerson()
        wait_for(person, LIFT)
        if person.answer.strip() != LIFTED:
            raise TrialRefusal("not_lifted")
        result = try_robot(settings.robot, robot, person)
    except TrialRefusal as refused:
        print("\n".join(refusal_lines(refused)), file=sys.stderr)
        return EXIT_REFUSED
    except (ConfigError, CalibrationRefusal, OSError) as trouble:
        print("\n".join(refusal_lines(refusal_of(trouble))), file=sys.stderr)
        return EXIT_REFUSED
    except KeyboardInterrupt:
        told = pick("interrupted: the wheels stand, nothing was written", "已中断：轮子已停")
        print(told, file=sys.stderr)
        return EXIT_INTERRUPTED
    kept = result.kept.name
    print(f"proved; wrote [trial] into {settings.robot}, the old one is {kept}", flush=True)
    return EXIT_PROVED


def refusal_lines(refused: TrialRefusal) -> list[str]:
    """Return what a person is told of a refusal: code, what came, and the cure."""
    detail = f" ({refused.detail})" if refused.detail else ""
    nothing = pick("nothing was written", "未写入任何内容")
    return [f"{refused.code}{detail}", f"  {pick(*REFUSALS[refused.code])}", nothing]


class TerminalPerson:
    """Ask at the terminal; Enter is the answer. Ctrl-C ends it at each moment."""

    def __init__(self) -> None:
        self.answer = ""
        self._step = LIFT

    def ask(self, code: str) -> None:
        """Print what is asked for."""
        ends = _LIFTED if code == LIFT else _DONE
        print(f"\n{pick(*PROMPTS[code])}{pick(*ends)} … ", end="", flush=True)

    def has_answered(self) -> bool:
        """Tell whether Enter was pressed; an end of input is an interrupt: nobody watches."""
        if not select.select([sys.stdin], [], [], 0.0)[0]:
            return False
        self.answer = sys.stdin.readline()
        if not self.answer:
            raise KeyboardInterrupt
        return True

    def tell(self, step: str, seen: str = "") -> None:
        """Print what the step that has ended saw."""
        if seen:
            print(f"{pick(*STEPS[self._step])}: {seen}", flush=True)
        self._step = step

    def require_watch(self) -> None:
        """Go on: who has the terminal can press Ctrl-C."""
