"""Sentences of a site's owner: read as ours are; what can't be read is told with its cure."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from maps.errors import SiteError
from planner.language.grammar import Context, plan
from planner.language.templates.expressions import TemplateError
from planner.language.templates.owners import read_owners_templates
from planner.plan import EVERY_KIND, GoalState, GoTo, StepPlan
from planner.site import KnownPlaces, Site
from pons_assets import DEFAULT_SITE
from tests.planner.language.grammar.conftest import HOME
from tools.lockstep import LockstepWorld

OWN = """
[words.en]
away = "scoot|off you pop"

[[template]]
plan = "drive_to(place)"
en = ["<away> [over] to {place:spot}"]
zh = ["溜达到{place:spot}"]
"""
THEIRS = HOME.model_copy(update={"sentences": OWN})


@pytest.mark.parametrize(
    "said", ["scoot to the kitchen", "please off you pop over to the kitchen", "溜达到厨房"]
)
def test_an_owners_sentence_acts_at_once(said: str) -> None:
    context = Context(runnable=EVERY_KIND)
    assert plan(said, THEIRS, context) == StepPlan(steps=(GoTo(place="kitchen"),))
    assert not isinstance(plan(said, HOME, context), StepPlan)


@pytest.mark.parametrize(
    "said",
    ["don't scoot to the kitchen", "I scoot to the kitchen", "别溜达到厨房",
     "scoot to the kitchen if it rains", "scoot to the moon"],
)  # fmt: skip
def test_vetoes_stand_before_it(said: str) -> None:
    assert not isinstance(plan(said, THEIRS, Context(runnable=EVERY_KIND)), StepPlan)


@pytest.mark.parametrize(
    ("wrong", "line", "told"),
    [
        ('\n[[template]]\nplan = "fly(place)"', None, "drive_to("),
        ('\n[[template]]\nplan = "drive_to(speed)"', None, "drive_to("),
        ('\n\n[[template]]\nplan = "home()"\nen = ["go (home"]', "line 4", "missing"),
        ("[[template]", "line 1", "TOML"),
    ],
)
def test_what_cant_be_read_is_told_with_line_and_cure(
    tmp_path: Path, wrong: str, line: str | None, told: str
) -> None:
    with pytest.raises(TemplateError) as raised:
        read_owners_templates(wrong)
    assert line is None or line in str(raised.value)
    assert told in str(raised.value)
    folder = tmp_path / "site"
    shutil.copytree(DEFAULT_SITE, folder)
    (folder / "sentences.toml").write_text(wrong, "utf-8")
    with pytest.raises(SiteError) as refused:
        Site.load(folder)
    assert refused.value.code == "bad_template"
    assert "sentences.toml" in refused.value.message["en"]
    assert any("一" <= char <= "鿿" for char in refused.value.message["zh"])


@pytest.mark.parametrize("text", [b"\xff\xfe", b"#" * 16_001])
def test_what_is_no_text_is_refused(tmp_path: Path, text: bytes) -> None:
    folder = tmp_path / "site"
    shutil.copytree(DEFAULT_SITE, folder)
    (folder / "sentences.toml").write_bytes(text)
    with pytest.raises(SiteError, match=r"sentences\.toml"):
        Site.load(folder)


def test_a_robot_drives_upon_an_owners_sentence(tmp_path: Path) -> None:
    folder = tmp_path / "home"
    shutil.copytree(DEFAULT_SITE, folder)
    (folder / "sentences.toml").write_text(OWN, "utf-8")
    assert KnownPlaces(Site.load(folder)).vocabulary.sentences == OWN
    world = LockstepWorld(site=folder)
    goal = world.say("scoot over to the study")
    world.run_until(lambda _: goal.state is GoalState.RUNNING, 20.0)
