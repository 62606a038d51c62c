"""Try the route of the owner's skills."""

from __future__ import annotations

import asyncio
from pathlib import Path

from planner.skill_files.folder import FOLDER, SkillFolder
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of


def test_skills_and_what_is_wrong_in_the_others_are_listed(tmp_path: Path) -> None:
    services = FakeServices()
    services.skills = SkillFolder(tmp_path, lambda: services.memory.vocabulary)
    (tmp_path / FOLDER).mkdir()
    good = 'en = "do the evening round"\nsteps = [{kind = "return_home"}]\n'
    (tmp_path / FOLDER / "round.toml").write_text(good, "utf-8")
    (tmp_path / FOLDER / "bad.toml").write_text("\nen = ", "utf-8")
    asyncio.run(services.skills.look())
    told = client_of(services).get("/v1/skills")
    assert told.status_code == 200
    [skill], [problem] = told.json()["skills"], told.json()["problems"]
    assert (skill["name"], skill["kind"]) == ("round", "routine")
    assert skill["en"] == ["do the evening round"]
    assert (problem["file"], problem["line"], problem["code"]) == ("bad.toml", 2, "skill_not_toml")
    assert set(problem["message"]) == {"en", "zh"}
    assert told.json()["folder"] == str(tmp_path / FOLDER)
