"""A skill is saved while the robot runs, its words are said, and the robot drives its steps."""

from __future__ import annotations

import time

import pytest

from tests.e2e.polling import until
from tests.e2e.robot import Robot

pytestmark = [pytest.mark.e2e, pytest.mark.nightly]


def test_a_saved_skill_is_driven_by_its_words_and_a_broken_one_moves_nothing(robot: Robot) -> None:
    folder = robot.system.home / "skills"
    folder.mkdir(exist_ok=True)
    place = robot.elsewhere()
    visit = folder / "visit.py"
    broken = folder / "broken.py"

    def names() -> set[str]:
        told = robot.system.http("GET", "/v1/skills").body
        return {each["name"] for each in told["skills"]}

    try:
        saved_s = time.monotonic()
        visit.write_text(
            "from pons.skill import Place, Step, go_to, say\n\n\n"
            "def visit(where: Place) -> list[Step]:\n"
            '    """Visit a place.\n\n    en: pay a call at {where}\n    """\n'
            "    return [go_to(where), say('Here I am.')]\n",
            "utf-8",
        )
        until(lambda: "visit" in names(), 10.0, "a skill that can be said", robot.judge.describe)
        print(f"saved to usable: {time.monotonic() - saved_s:.2f} s")
        goal = robot.system.give(f"pay a call at the {place.name.en}")
        ended = robot.arrive(place, goal)
        assert [step["kind"] for step in ended["plan"]["steps"]] == ["go_to", "say"]
        asked = "remember that as the morning call"
        kept = robot.system.until_goal(robot.system.give(asked)["id"], "succeeded")
        assert "morning_call.toml" in kept["outcome"]["message"]["en"]
        assert "morning_call" in names()
        broken.write_text(
            'def broken() -> str:\n    """Hum.\n\n    en: hum the old tune\n    """\n'
            "    while True:\n        pass\n",
            "utf-8",
        )
        until(lambda: "broken" in names(), 10.0, "the broken skill", robot.judge.describe)
        lost = robot.system.give("hum the old tune")
        failed = robot.system.until_goal(lost["id"], "failed", "refused")
        assert failed["outcome"]["code"] == "skill_failed"
        assert "broken.py" in failed["outcome"]["message"]["en"]
        robot.judge.assert_never_moves(0.2)
    finally:
        for path in folder.iterdir():
            path.unlink()
