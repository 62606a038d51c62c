"""Read a sentence into a plan: the offline brain, as one pure function.

The law: every word of the sentence is accounted for by the grammar, or nothing moves; and every
place that a plan drives to is named by the sentence.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from planner.language.catalogue import message
from planner.language.folding import CHINESE as HAN
from planner.language.folding import has_chinese
from planner.language.grammar.checks import TAMPERING, broken_rule, find_veto, withholds_offers
from planner.language.grammar.clauses import (
    ClauseReading,
    Grammar,
    at_each,
    in_order,
)
from planner.language.grammar.compound import read_compound
from planner.language.grammar.compound_forms import PartReaders
from planner.language.grammar.context import NOWHERE, Context
from planner.language.grammar.en.compound import ENGLISH_COMPOUND
from planner.language.grammar.en.orders import ENGLISH
from planner.language.grammar.lexicon import (
    MARK,
    MarkedText,
    lexicon_of,
    mark_people,
    person_named,
)
from planner.language.grammar.parse_result import (
    TALK,
    ClauseContext,
    ClauseProblem,
    Meaning,
    Reading,
    Rule,
    TopicQuestion,
    read_by,
)
from planner.language.grammar.plan_assembly import Setting, compose, limit_to_means, unsafe, veto
from planner.language.grammar.questions_whether import asks_whether
from planner.language.grammar.quotes import put_quotes_back, take_quotes
from planner.language.grammar.sentence_text import (
    EXAMPLE,
    mend,
    normalise,
    refuse_bad_text,
    refuse_long_text,
    words_of,
)
from planner.language.grammar.zh.compound import CHINESE_COMPOUND
from planner.language.grammar.zh.orders import CHINESE
from planner.language.recall import read_recall
from planner.language.sentence import parse
from planner.language.stop import StopReading
from planner.language.templates.reader import read_exactly
from planner.language.templates.template_file import template_words
from planner.plan import (
    AnswerPlan,
    Clarify,
    Code,
    Language,
    Patrol,
    Recall,
    Refuse,
    Repeat,
    Step,
    StepPlan,
    Vocabulary,
    check_plan,
)

_OTHER = rf"(?:{MARK}|[{HAN}])"
_SEAM = re.compile(rf"(?<=[a-z0-9])(?={_OTHER})|(?<={_OTHER})(?=[a-z0-9])")
_BORDERS = re.compile(r"^[\s,.!?;:。、~]+|[\s,.!?;:。、~]+$")
_LATIN = re.compile(r"[a-z]")

_SPELT = (
    words_of(
        *(rule.pattern for rule in ENGLISH.rules if isinstance(rule, Rule)),
        *(veto for _, veto in ENGLISH.vetoes),
    )
    | template_words()
)


def plan(
    text: str, vocabulary: Vocabulary, context: Context = NOWHERE
) -> StepPlan | AnswerPlan | Clarify | Refuse:
    """Return the plan of a sentence. Same arguments, same plan; never raises on any text."""
    refused = refuse_bad_text(text)
    text = " ".join(text.split())
    refused = refused or refuse_long_text(text)
    if refused is not None:
        return refused
    exact = _read_exactly(text, vocabulary, context)
    if exact is not None:
        return exact
    return _plan_as_said(text, vocabulary, context)


def _read_exactly(
    text: str, vocabulary: Vocabulary, context: Context
) -> StepPlan | AnswerPlan | Clarify | Refuse | None:
    """Return the plan of one order whose every word a template names; None of any other.

    No template names a word of denial, condition or choice; what is said around the order may
    ("when there, …"), and a drive "over" somebody is made of a template's words.
    """
    said = parse(text)
    grammar = CHINESE if has_chinese(text) else ENGLISH
    if said.reading is StopReading.ORDER:
        return None
    lexicon = lexicon_of(vocabulary)
    marked = lexicon.mark(normalise(text))
    vetoes = (veto for each in (ENGLISH, CHINESE) for _, veto in each.vetoes)
    if any(veto.search(marked.text) for veto in vetoes) or broken_rule(marked.text):
        return None
    clause = grammar.plain(_BORDERS.sub("", marked.text))
    language, moved = context.language or said.language, context.moved or context.departed
    reading = Reading(marked, lexicon, vocabulary, language, maps="explore" in context.runnable)
    steps = read_exactly(clause, reading, context.runnable)
    if steps is None:
        return None
    setting = Setting(vocabulary, lexicon, language, context.room, context.now, moved=moved)
    return compose([steps], marked.restore(marked.text), setting)


def means_already(text: str, vocabulary: Vocabulary) -> bool:
    """Tell whether a sentence is an order whose every word is read, or one that is answered."""
    if _read_exactly(" ".join(text.split()), vocabulary, NOWHERE) is not None:
        return True
    return isinstance(plan(text, vocabulary), AnswerPlan)


def _is_round(plan: StepPlan) -> bool:
    """Tell whether a plan begins with steps that are done so many times."""
    return isinstance(plan.steps[0], Repeat)


def _has_patrol(plan: StepPlan) -> bool:
    """Tell whether a plan drives round by itself."""
    return any(isinstance(step, Patrol) for step in plan.steps)


def _plan_as_said(
    text: str, vocabulary: Vocabulary, context: Context
) -> StepPlan | AnswerPlan | Clarify | Refuse:
    """Return the plan of a sentence by its own words."""
    refused = refuse_bad_text(text)
    if refused is not None:
        return refused
    # The stop lane comes first; should a stop get here, it stays a stop.
    if parse(text).reading is StopReading.ORDER:
        return Refuse(code=Code.STOPPED, reason=message(Code.STOPPED))
    recalled = read_recall(text, vocabulary, context.room)
    asks = recalled is not None and (context.remembers or not recalled.present)
    if recalled is not None and asks and "recall" in context.runnable:
        return StepPlan(steps=(recalled.step,))
    apart, quotes = take_quotes(text)
    said = normalise(apart)
    sentence = _Sentence(text, apart, quotes)
    whole = _read_compound(said, sentence, vocabulary, context)
    if whole is not None and not _is_round(whole):
        return whole
    made = _read_once(said, sentence, vocabulary, context)
    if whole is not None and not (isinstance(made, StepPlan) and _has_patrol(made)):
        return whole  # "twice" is a patrol's own word where the grammar reads it as such
    if isinstance(made, Clarify) and made.code is Code.NOT_UNDERSTOOD:
        mended = mend(said, _SPELT)  # only now: "the green cup" is no "greet"
        if mended != said:
            second = _read_once(mended, sentence, vocabulary, context)
            lost = isinstance(second, Clarify) and second.code is Code.NOT_UNDERSTOOD
            return made if lost else second
    return made


@dataclass(frozen=True, slots=True)
class _Sentence:
    """Hold a sentence as written, without its quotations, and these."""

    text: str
    apart: str
    quotes: tuple[str, ...]


def _read_compound(
    said: str, sentence: _Sentence, vocabulary: Vocabulary, context: Context
) -> StepPlan | None:
    """Read a sentence whose orders hang on something; each of its parts is read as one alone."""
    if context.moved or TAMPERING.pattern.search(said):
        return None
    part_of = context.model_copy(update={"moved": True})

    def read_steps(part: str) -> tuple[Step, ...] | None:
        spoken = put_quotes_back(part, sentence.quotes)
        apart, quotes = take_quotes(spoken)
        of_part = _Sentence(spoken, f"{apart}. {sentence.apart}", quotes)
        made = _read_once(normalise(apart), of_part, vocabulary, part_of)
        return made.steps if isinstance(made, StepPlan) else None

    def read_person(words: str) -> str | None:
        return person_named(words, sentence.apart)

    def read_memory(question: str) -> Recall | None:
        asked = read_recall(question, vocabulary, context.room)
        return asked.step if asked is not None and "recall" in context.runnable else None

    tongue = Language.ZH if has_chinese(said) else Language.EN
    readers = PartReaders(
        read_steps, read_memory, lambda place: vocabulary.name(place).of(tongue), read_person
    )
    forms = CHINESE_COMPOUND if tongue is Language.ZH else ENGLISH_COMPOUND
    made = read_compound(said.strip(" ,.!?;。"), forms, readers)
    lacks = made is None or check_plan(made, vocabulary, context.runnable, context.blind)
    return None if lacks else made


def _read_once(
    said: str,
    sentence: _Sentence,
    vocabulary: Vocabulary,
    context: Context,
) -> StepPlan | AnswerPlan | Clarify | Refuse:
    """Read a normalised sentence once."""
    text, apart, quotes = sentence.text, sentence.apart, sentence.quotes
    lexicon = lexicon_of(vocabulary)
    marked = mark_people(lexicon.mark(said), apart)
    language, moved = context.language or parse(text).language, context.moved or context.departed
    offers = not withholds_offers(marked.text)
    setting = Setting(vocabulary, lexicon, language, context.room, context.now, offers, moved)
    bare = _BORDERS.sub("", marked.text)
    things = context.things if "go_to_object" in context.runnable else frozenset()
    maps = "explore" in context.runnable
    reading = Reading(marked, lexicon, vocabulary, language, quotes, context.now, things, maps=maps)
    topic = read_by(TALK, bare, reading)
    if isinstance(topic, TopicQuestion):  # it moves nothing: "… or just that there's a person?"
        return compose([topic], bare, setting)
    vetoed = _apply_vetoes(marked, setting)
    if vetoed is not None:
        return vetoed
    ordered = replace(marked, text=in_order(marked.text))
    tongue = Language.ZH if has_chinese(text) else Language.EN
    meanings = [
        limit_to_means(meaning, context.runnable, context.blind)
        for meaning in _meanings(ordered, reading, tongue)
    ]
    if not meanings:
        return Refuse(code=Code.EMPTY_GOAL, reason=message(Code.EMPTY_GOAL, example=EXAMPLE))
    return compose(meanings, marked.restore(marked.text), setting)


def _apply_vetoes(
    marked: MarkedText, setting: Setting
) -> StepPlan | AnswerPlan | Clarify | Refuse | None:
    """Look for words that turn an order into something else, in both languages at once."""
    text = marked.restore(marked.text)
    if TAMPERING.pattern.search(text):
        return unsafe(TAMPERING.rule, text)
    found = find_veto(asks_whether(marked.text), (ENGLISH.vetoes, CHINESE.vetoes))
    if found is None or not found.denies:  # "don't hit the wall" is a no; "hit the wall" a rule
        rule = broken_rule(marked.text)
        if rule is not None:
            return unsafe(rule, text)
    return veto(found, marked, setting) if found else None


def _meanings(marked: MarkedText, reading: Reading, language: Language) -> list[Meaning]:
    """Read the clauses; a Chinese sentence with Latin words is also tried as an English one."""
    if language is Language.EN:
        return _read(ENGLISH, marked.text, reading)
    meanings = _read(CHINESE, marked.text, reading)
    if _LATIN.search(marked.text) and _is_lost(meanings):
        mixed = _read(ENGLISH, _SEAM.sub(" ", marked.text), reading)
        return meanings if _is_lost(mixed) else mixed
    return meanings


def _is_lost(meanings: Sequence[Meaning]) -> bool:
    lost = {Code.NOT_UNDERSTOOD, Code.UNKNOWN_PLACE}
    return any(isinstance(meaning, ClauseProblem) and meaning.code in lost for meaning in meanings)


def _read(grammar: Grammar, text: str, reading: Reading) -> list[Meaning]:
    heard: list[ClauseReading] = []
    scene = ClauseContext()
    for clause in grammar.clauses(text):
        here = reading.at(clause, scene)
        meaning = grammar.read(clause, here)
        heard.append(ClauseReading(clause, meaning, here))
        scene = scene.after(meaning)
    return list(at_each(heard, grammar.read))
