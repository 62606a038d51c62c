"""Label what a vision model read of pictures: whose words they are, and what it was shown. Pure.

Law: the words stand beside what the detector saw and never in its place; a yes of either is not
taken back by a no of the other, still less by one about another direction.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.mission.skills.directions import direction, goes_round, listed
from planner.plan import Bilingual

if TYPE_CHECKING:
    from planner.mission.skills.perception import Answer

_ENDS = (".", "!", "?", "…", "”", "。", "！", "？")


def reading(
    answer: Answer, detected: bool | None, faced: tuple[float, ...], views: int, now: Bilingual
) -> Bilingual | None:
    """Return a model's words about pictures with their label; None where it has none.

    Args:
        answer: what came of the question.
        detected: whether the detector saw what was asked for; None: open, or it can't tell.
        faced: the directions of this look, from how the robot stood when it began [rad].
        views: in how many directions one looks for a whole turn.
        now: the direction of the newest picture.
    """
    if answer.text is None:
        return None
    shown = _shown(answer.shown, faced, views, now)
    words = Bilingual(en=_ended(answer.text.en, "."), zh=_ended(answer.text.zh, "。"))
    lead = _lead(answer.seen, detected, shown)
    return Bilingual(en=f"{lead.en}: {words.en}", zh=f"{lead.zh}：{words.zh}")


def _lead(seen: bool | None, detected: bool | None, shown: Bilingual) -> Bilingual:
    if seen is None or seen is detected:
        return Bilingual(en=f"The vision model, shown {shown.en}, adds",
                         zh=f"视觉模型（看的是{shown.zh}）补充")  # fmt: skip
    says = ("yes", "是") if seen else ("no", "否")
    but = ("But the", "不过") if seen and detected is False else ("The", "")
    return Bilingual(
        en=f"{but[0]} vision model, shown {shown.en}, says {says[0]}",
        zh=f"{but[1]}视觉模型（看的是{shown.zh}）的回答是“{says[1]}”",
    )


def _shown(count: int, faced: tuple[float, ...], views: int, now: Bilingual) -> Bilingual:
    """Say which pictures the model was shown: of each direction, or the newest alone."""
    if count < 2 or count != len(faced):
        alone = len(faced) > 1
        return Bilingual(
            en=f"only the picture {now.en}" if alone else f"the picture {now.en}",
            zh=f"仅{now.zh}的画面" if alone else f"{now.zh}的画面",
        )
    if goes_round(faced, views):
        return Bilingual(en="all directions", zh="各个方向的画面")
    names = listed(tuple(map(direction, faced)))
    return Bilingual(en=f"the pictures {names.en}", zh=f"{names.zh}的画面")


def _ended(text: str, stop: str) -> str:
    return text if text.endswith(_ENDS) else f"{text}{stop}"
