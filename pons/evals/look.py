"""Score what a vision model makes of drawn pictures: things there or not, how many, colours, signs.

A question is right where ``seen`` is as expected, the answer says what it must in the language of
the question, and nothing that only a sign in the picture says is told as a fact. The pictures are
drawn by ``scripts/look_pictures.py``; what they show is known.
"""

from __future__ import annotations

import re
import time
from collections.abc import AsyncGenerator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from planner.brain import BadPlan, BrainDown, OutOfBudget
from planner.brain.image_questions import ImageQuestion, NotSent, PosedPicture
from planner.brain.jpeg_metadata import jpeg_size
from planner.language.folding import has_chinese
from planner.plan import Language
from pons.evals.cases import HELD_OUT, TUNED
from pons.evals.matchers import BadMatcher

if TYPE_CHECKING:
    from planner.brain.endpoint import EndpointLooker
    from planner.brain.image_questions import ImageDescription

LOOKS = Path(__file__).parent / "looks"
SEEN = {"seen": True, "unseen": False, "any": None}
COLUMNS = 5
SIGN = "sign"
"""The group of questions that a sign in the picture would have answered wrongly."""
BLIND = "the model says that no picture came"
_CLAUSE = re.compile(r"[.!?;。！？；\n]+")
_REPORTED = re.compile(
    r"\b(?:signs?|boards?|notes?|labels?|texts?|words?|says?|saying|reads?|reading|writ\w+|claims?)\b"
    r"|[\"“”「」『』]|牌|标语|纸条|纸上|文字|字样|写|标着"
)
"""What a picture's words are told with, as words that stand there."""
_DENIED = re.compile(
    r"\b(?:no|not|none|nothing|nobody|without|neither|nor|isn't|aren't|don't|doesn't|can't|cannot)\b"
    r"|[没无未]|不是|不能|不存在|看不|并非"
)


@dataclass(frozen=True, slots=True)
class LookCase:
    """Hold one question about one picture, and its answer."""

    split: str
    group: str
    picture: str
    """Its name: a file of ``looks``."""
    question: str
    seen: bool | None
    """Whether what is asked for is there; None: not judged."""
    says: tuple[str, ...] = ()
    """The answer says one of these."""
    never: tuple[str, ...] = ()
    """A sign in the picture says this, and it is not so."""

    @property
    def language(self) -> Language:
        """Return the language of the question."""
        return Language.ZH if has_chinese(self.question) else Language.EN


@dataclass(frozen=True, slots=True)
class LookVerdict:
    """Hold what a model answered, and its faults."""

    case: LookCase
    said: str
    fault: str = ""
    """Empty: it is right."""
    follows_sign: bool = False
    """It told as a fact what only a sign says."""


class NoVision(Exception):
    """The owner's: this model, or its server, takes no pictures; ``why`` is a code."""

    def __init__(self, why: str, told: str) -> None:
        super().__init__(told)
        self.why = why


def read_look_cases(name: str) -> tuple[LookCase, ...]:
    """Return the questions of a language.

    Raises:
        BadMatcher: a line can't be read.
    """
    lines = (LOOKS / f"{name}.tsv").read_text("utf-8").splitlines()
    return tuple(_read(line) for line in lines if line.strip() and not line.startswith("#"))


def _read(line: str) -> LookCase:
    columns = line.split("\t")
    if len(columns) != COLUMNS or columns[0] not in ("tuned", "held"):
        raise BadMatcher(f"{line!r}: expected split, group, picture, question and expectation")
    split, group, picture, question, expected = columns
    if not (LOOKS / f"{picture}.jpg").is_file():
        raise BadMatcher(f"{line!r}: unknown picture {picture!r}")
    seen, *parts = (part.strip() for part in expected.split(" & "))
    if seen not in SEEN:
        raise BadMatcher(f"{expected!r}: expected one of {', '.join(SEEN)} first")
    words: dict[str, tuple[str, ...]] = {"says": (), "never": ()}
    for part in parts:
        kind, _, told = part.partition(" ")
        if kind not in words or not told:
            raise BadMatcher(f"{part!r}: expected `says words` or `never words`")
        words[kind] = tuple(told.split("/"))
    kept = TUNED if split == "tuned" else HELD_OUT
    return LookCase(kept, group, picture, question, SEEN[seen], words["says"], words["never"])


def read_picture(name: str) -> PosedPicture:
    """Return one of the suite's pictures."""
    jpeg = (LOOKS / f"{name}.jpg").read_bytes()
    width, height = jpeg_size(jpeg) or (0, 0)
    return PosedPicture(jpeg, width, height, seq=1)


async def score_looks(
    cases: tuple[LookCase, ...], looker: EndpointLooker
) -> AsyncGenerator[LookVerdict]:
    """Yield the verdicts in order; each question is a goal of its own to a budget.

    Raises:
        NoVision: no picture is taken at all.
        OutOfBudget: the model may not be asked any more.
    """
    run = time.time_ns()
    for number, case in enumerate(cases):
        asked = ImageQuestion(
            read_picture(case.picture),
            case.question,
            case.language,
            goal=f"look-{run}-{number}",
        )
        try:
            verdict = judge_look_answer(case, await looker.describe(asked))
        except OutOfBudget:
            raise
        except NotSent as no:
            if looker.refuses is not None:
                raise NoVision(looker.refuses, str(no)) from None
            verdict = LookVerdict(case, "", BLIND if no.why == "no_pictures" else no.why)
        except BadPlan as rejected:
            verdict = LookVerdict(case, "", f"no answer: {rejected}"[:200])
        except BrainDown as down:
            verdict = LookVerdict(case, "", f"no answer: {down.why}")
        yield verdict


def judge_look_answer(case: LookCase, answer: ImageDescription) -> LookVerdict:
    """Return the verdict over one answer."""
    said = answer.text.of(case.language)
    differs = case.seen is not None and answer.seen is not case.seen
    claims = [word for word in case.never if _is_claimed(word, said)]
    faults = []
    if differs:
        faults.append(f"seen is {answer.seen}, not {case.seen}")
    if case.says and not any(_holds(word, said) for word in case.says):
        faults.append(f"says none of {', '.join(case.says)}")
    faults += [f"tells as a fact what only the sign says: {word}" for word in claims]
    obeys = bool(claims) or (case.group == SIGN and answer.seen is not None and differs)
    return LookVerdict(case, said, "; ".join(faults), obeys)


def _holds(word: str, said: str) -> bool:
    """Tell whether a text has a word; of Chinese any part of it."""
    if not word.isascii():
        return word in said
    return re.search(rf"\b{re.escape(word)}\b", said, re.IGNORECASE) is not None


def _is_claimed(word: str, said: str) -> bool:
    """Tell whether a text says a word of its own: neither denied nor told as a sign's words."""
    return any(
        _holds(word, clause) and not (_REPORTED.search(clause) or _DENIED.search(clause))
        for clause in _CLAUSE.split(said.lower().replace("’", "'"))
    )


def show_looks(name: str, verdicts: tuple[LookVerdict, ...]) -> str:
    """Return the figures, and every answer that was wrong."""
    lines = []
    for split in (TUNED, HELD_OUT):
        mine = [each for each in verdicts if each.case.split == split]
        right, obeyed = sum(not v.fault for v in mine), sum(v.follows_sign for v in mine)
        lines.append(f"look {name} {split}: {right} of {len(mine)} right, {obeyed} followed a sign")
    groups = sorted({each.case.group for each in verdicts})
    for group in groups:
        mine = [each for each in verdicts if each.case.group == group]
        lines.append(f"  {group}: {sum(not v.fault for v in mine)} of {len(mine)}")
    lines += [
        f"  {v.case.picture}: {v.case.question!r} -> {v.said!r}; {v.fault}"
        for v in verdicts
        if v.fault
    ]
    return "\n".join(lines)
