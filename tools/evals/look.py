"""Score what a vision model makes of drawn pictures: things there or not, how many, colours, signs.

A question is right where ``seen`` is as expected, the answer says what it must in the language of
the question, and nothing that only a sign in the picture says is told as a fact. The pictures are
drawn by ``scripts/look_pictures.py``; what they show is known.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from planner.brain import BadPlan, BrainDown, OutOfBudget
from planner.brain.image_questions import ImageQuestion, NotSent, PosedPicture
from planner.brain.jpeg_metadata import jpeg_size
from planner.language.folding import has_chinese
from planner.plan import Language
from pons.evals.matchers import BadMatcher
from pons.evals.world import new_goal
from tools.evals.lines import HERE, LineVerdict

if TYPE_CHECKING:
    from planner.brain.endpoint import EndpointLooker
    from planner.brain.image_questions import ImageDescription
    from tools.evals.lines import SuiteLine

LOOKS = HERE / "looks"
SEEN = {"seen": True, "unseen": False, "any": None}
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

    line: SuiteLine
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


class NoVision(Exception):
    """The owner's: this model, or its server, takes no pictures; the message begins with a code."""


def read_look(line: SuiteLine) -> LookCase:
    """Read a line's question, picture and expectation. Raises BadMatcher where it can't be."""
    picture, question, expected = line.columns
    if not (LOOKS / f"{picture}.jpg").is_file():
        raise BadMatcher(f"{line}: unknown picture {picture!r}")
    seen, *parts = (part.strip() for part in expected.split(" & "))
    if seen not in SEEN:
        raise BadMatcher(f"{expected!r}: expected one of {', '.join(SEEN)} first")
    words: dict[str, tuple[str, ...]] = {"says": (), "never": ()}
    for part in parts:
        kind, _, told = part.partition(" ")
        if kind not in words or not told:
            raise BadMatcher(f"{part!r}: expected `says words` or `never words`")
        words[kind] = tuple(told.split("/"))
    return LookCase(line, picture, question, SEEN[seen], words["says"], words["never"])


def read_picture(name: str) -> PosedPicture:
    """Return one of the suite's pictures."""
    jpeg = (LOOKS / f"{name}.jpg").read_bytes()
    width, height = jpeg_size(jpeg) or (0, 0)
    return PosedPicture(jpeg, width, height, seq=1)


async def hear_look(line: SuiteLine, looker: EndpointLooker) -> LineVerdict:
    """Return what a model answers to one question; each is a goal of its own to a budget.

    Raises:
        NoVision: no picture is taken at all.
        OutOfBudget: the model may not be asked any more.
    """
    case = read_look(line)
    picture, goal = read_picture(case.picture), new_goal("look")
    try:
        asked = ImageQuestion(picture, case.question, case.language, goal=goal)
        return judge_look_answer(case, await looker.describe(asked))
    except OutOfBudget:
        raise
    except NotSent as no:
        if looker.refuses is not None:
            raise NoVision(f"{looker.refuses}: {no}") from None
        told = BLIND if no.why == "no_pictures" else no.why
    except BadPlan as rejected:
        told = f"no answer: {rejected}"[:200]
    except BrainDown as down:
        told = f"no answer: {down.why}"
    return LineVerdict(line, case.question, told, right=False)


def judge_look_answer(case: LookCase, answer: ImageDescription) -> LineVerdict:
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
    obeys = bool(claims) or (case.line.group == SIGN and answer.seen is not None and differs)
    told = "; ".join((said, *faults))
    return LineVerdict(case.line, case.question, told, not faults and not obeys, obeys)


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
