"""Read what a person wants remembered or forgotten: whole sentences, word for word. Pure.

A fact is no order, whatever it says. A sentence that goes on after it is left to a brain. What
corrects a fact ("the passports aren't on the desk any more", 讲错了在沙发上) is one, too. Law: a
pronoun means the thing of the fact that was told just before; what names none corrects none.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.commands import chinese, english
from planner.language.commands.command import ENDS, QUOTES, ForgetFacts, TeachFact, write_plainly
from planner.language.commands.statements import NOUN, SPOTS, find_statement
from planner.language.folding import fold_script, has_chinese

if TYPE_CHECKING:
    from types import ModuleType

    from planner.language.commands.command import ENDS, QUOTES, FoldedText, write_plainly


MAX_STATEMENT = 90
"""Characters; a flat statement is short."""


def read_fact_order(said: FoldedText, grammar: ModuleType) -> TeachFact | ForgetFacts | None:
    """Return what is to be remembered or forgotten, or None."""
    return _read_forgetting(said, grammar) or _read_teaching(said, grammar)


def read_long_fact(said: FoldedText, grammar: ModuleType) -> TeachFact | None:
    """Return what is to be remembered of a text that is too long for any other command."""
    return _read_teaching(said, grammar) if grammar.LESSON.match(said.folded) else None


def _read_forgetting(said: FoldedText, grammar: ModuleType) -> ForgetFacts | None:
    for pattern, told, seen in (
        (grammar.FORGET_TOLD, True, False),
        (grammar.FORGET_SEEN, False, True),
        (grammar.FORGET_ALL, True, True),
        (grammar.FORGET_ABOUT, True, True),
    ):
        found = pattern.fullmatch(said.folded)
        if found is None:
            continue
        group = next((name for name, text in found.groupdict().items() if text), None)
        about = said.part(*found.span(group)).written if group else ""
        about = about.strip(ENDS + QUOTES)
        if pattern is grammar.FORGET_ABOUT and (not about or _PRONOUN.fullmatch(about.lower())):
            return None
        return ForgetFacts(about, told=told or bool(about), seen=seen)
    return None


_PRONOUN = re.compile(
    r"it|that|this|them|him|her|me|us|you|going.*|driving.*|那|这|它|他|她|我|你|刚才|刚才说"
)


def _read_teaching(said: FoldedText, grammar: ModuleType) -> TeachFact | None:
    found = grammar.TEACH.fullmatch(said.folded)
    kept = grammar.KEPT.search(said.folded)
    if kept is not None and grammar.STATEMENT.fullmatch(said.folded[: kept.start()]):
        return TeachFact(said.part(0, kept.start()).written.strip(ENDS + QUOTES))
    if found is None:
        return None
    group = next(name for name, text in found.groupdict().items() if text is not None)
    fact = said.part(*found.span(group))
    words = fact.written.strip(ENDS + QUOTES)
    here = grammar.THIS_IS.fullmatch(fact.folded) is not None
    return TeachFact(words, here=here) if words else None


def read_statement(text: str) -> TeachFact | None:
    """Return a flat statement of where something is, as a fact; None for anything else."""
    written = write_plainly(text).strip(ENDS)
    if not 0 < len(written) <= MAX_STATEMENT:
        words = find_statement(text)
        return TeachFact(words) if words is not None else None
    grammar = chinese if has_chinese(written) else english
    whole = grammar.STATEMENT.fullmatch(fold_script(written.lower()))
    if whole is not None:
        return TeachFact(written)
    words = find_statement(text)
    return TeachFact(words) if words is not None else None


_NO = (
    r"(?:(?:no|nope|wait|hang on|hold on|sorry|oops|oh|ah|actually|scratch that|my mistake"
    r"|correction)[ ,.!]+)"
)
_SAW = (
    r"(?:[,;.] (?:i|we)(?:'ve| have)? (?:just )?(?:saw|see|found|seen|checked|moved|remember"
    r"|remembered)(?: (?:it|them|now|that))*)?"
)
_ANAPHOR = re.compile(
    rf"{_NO}*(?:i meant? )?(?P<it>they|it)(?:'re|'s| are"
    rf"| is) (?:not {SPOTS},? (?:but )?)?(?:actually |now |really )*(?P<at>{SPOTS}){_SAW}"
    rf"|{_NO}+(?:i meant? |rather )?(?P<at2>{SPOTS}){_SAW}"
    rf"|{_NO}*i(?:'ve| have)? (?:just )?(?:moved|put|taken) (?P<it2>them"
    rf"|it) (?:back )?(?P<at3>{SPOTS})"
)
_MOVED = re.compile(
    rf"{_NO}*(?P<a>{NOUN})(?:'s| is|'re| are)? ?(?:isn't|aren't|not|n't) {SPOTS} (?:any ?more"
    rf"|any longer|now)(?:[,;.] .{{3,60}})?"
    rf"|{_NO}*(?:i|we)(?:'ve| have)? (?:just )?moved (?P<b>{NOUN}) {SPOTS}"
    rf"|{_NO}*(?:i|we)(?:'ve| have)? (?:just )?moved (?P<c>{NOUN})[,;.]? (?:and )?(?:it"
    rf"|they)(?:'s|'re| is| are) .{{3,60}}"
)
_DOES = re.compile(r"\b(?:please|go|come|drive|find|look|check|tell|ask|remind|if|when|you)\b|\?")
_SUBJECT = re.compile(
    rf"(?:[a-z ]{{0,24}}[,:] ?)?(?:(?P<a>{NOUN})(?: (?:is|are)|'s|'re)(?:n't)? (?:not |still "
    rf"|now |always )*{SPOTS}.*"
    rf"|(?:i|we|he|she|they)(?:'ve| have)? (?:just |already )?[a-z]+ (?P<b>{NOUN}) {SPOTS}.*)"
)
_ARTICLE = re.compile(r"^(?:the|my|our|your|his|her|their|a|an|some) ")
_NO_ZH = (
    r"(?:[哎哦噢啊诶欸唉呀]|(?:我)?(?:讲|说|记|搞|弄)?错(?:了|啦)|不对|不是|等等|等一下"
    r"|抱歉|不好意思|更正一下|[,。!])"
)
_ANAPHOR_ZH = re.compile(
    rf"(?P<no>{_NO_ZH}*)(?:我是说|应该|其实|是|它们?)*(?:不在.{{1,10}}[,]?(?:而)?是?)?(?:放)?在(?P<at>[^,;。!?吗呢]{{2,14}}?)(?:才对|才是|啦|了|哦)?"
)
_MOVED_ZH = re.compile(
    r"(?P<a>[^,;。!?在我你]{1,12}?)(?:已经|现在)?不在[^,;。!?]{1,12}了(?:,.{3,30})?"
    r"|(?:我)?(?:刚|刚才|已经)?把(?P<b>[^,;。!?]{1,12}?)(?:移|搬|挪|换|改放)(?:到|去|在)[^,;。!?]{2,12}了?"
    r"|(?P<c>[^,;。!?在我你]{1,12}?)(?:移|搬|挪|换|改放|拿)(?:到|去|在)[^,;。!?]{2,12}了"
)
_DOES_ZH = re.compile(r"[吗呢?？]|什么|哪|谁|请|帮|提醒|告诉|如果|要是|去找|看看|你")
_SUBJECT_ZH = re.compile(
    r"(?:(?:跟你|告诉你|对了|记住|记得).{0,6}[,:])?(?:(?:我|我们)?把(?P<b>[^,;。!?]{1,12}?)(?:放|收|贴|挂|搁|塞|停|藏|移|搬)"
    r"|(?P<a>[^,;。!?在]{1,12}?)(?:还|就|都)?(?:放|收|贴|挂|搁|塞|停|藏|移|搬)?(?:在|到))(?P<at>.+)"
)


def read_fact_correction(text: str, told: str | None) -> TeachFact | None:
    """Return the fact that a sentence puts in place of an older one; None where it corrects none.

    Args:
        text: what a person said.
        told: the words of the fact that was told just before; None: there was none.
    """
    written = write_plainly(text).strip(ENDS)
    folded = fold_script(written.lower())
    if not folded or len(folded) != len(written) or len(folded) > 140:
        return None
    if has_chinese(folded):
        return _correct_chinese(folded, written, told)
    if _DOES.search(folded):
        return None
    moved = _MOVED.fullmatch(folded)
    if moved is not None:
        group = next(name for name, words in moved.groupdict().items() if words)
        start = re.match(rf"{_NO}*", folded)
        begins = start.end() if start is not None else 0
        return TeachFact(written[begins:], instead_of=_bare(moved[group]))
    thing = name_subject(told) if told is not None else ""
    again = _tell_anew(folded, written, thing, re.compile(rf"{_NO}+(?:i meant? |rather )?"))
    if again is not None:
        return again
    meant = _ANAPHOR.fullmatch(folded)
    if meant is None or not thing or told is None:
        return None
    at = next(name for name in ("at", "at2", "at3") if meant[name])
    where = written[slice(*meant.span(at))]
    where = re.sub(r"^(?:to|into|onto) ", "in ", where) if at == "at3" else where
    said = meant["it"] or meant["it2"] or ""
    several = said in ("they", "them") or (not said and re.search(r"\bare\b", told.lower()))
    named = told[told.lower().index(thing) :][: len(thing)]
    whose = re.search(
        rf"\b((?:the|my|our|your|his|her|their) ){re.escape(thing)}", told, re.IGNORECASE
    )
    owner = whose[1] if whose is not None else ""
    return TeachFact(f"{owner}{named} {'are' if several else 'is'} {where}", instead_of=thing)


_SAME_ZH = re.compile(
    rf"{_NO_ZH}+(?:我(?:是)?说)?(?P<a>[^,;。!?在你]{{1,10}}?)(?:应该|其实|是|都|就|现在)*(?:放|搁|收)?在"
    r"(?P<at>[^,;。!?吗呢]{1,14}?)(?:才对|才是|啦|了|哦)?"
)
"""The same thing is named again: 不对，钥匙在餐桌上."""


def _correct_chinese(folded: str, written: str, told: str | None) -> TeachFact | None:
    if _DOES_ZH.search(folded):
        return None
    moved = _MOVED_ZH.fullmatch(folded)
    if moved is not None:
        return TeachFact(written, instead_of=next(words for words in moved.groups() if words))
    thing = name_subject(told) if told is not None else ""
    again = _tell_anew(folded, written, thing, re.compile(rf"{_NO_ZH}+(?:我是说|其实|应该是)?"))
    if again is not None:
        return again
    same = _SAME_ZH.fullmatch(folded)
    if same is not None and thing and _same_thing(same["a"], thing):
        return TeachFact(f"{thing}在{written[slice(*same.span('at'))]}", instead_of=thing)
    meant = _ANAPHOR_ZH.fullmatch(folded)
    if (
        meant is None
        or not thing
        or not re.search(r"错|不对|不是|等|抱歉|不好意思|更正", meant["no"])
    ):
        return None
    return TeachFact(f"{thing}在{written[slice(*meant.span('at'))]}", instead_of=thing)


def _tell_anew(folded: str, written: str, thing: str, no: re.Pattern[str]) -> TeachFact | None:
    """Return what is told of the same thing behind a "no": 不对不对，钥匙在餐桌上."""
    lead = no.match(folded)
    if lead is None or not thing or name_subject(written[lead.end() :]) != thing:
        return None
    return TeachFact(written[lead.end() :], instead_of=thing)


def _same_thing(said: str, thing: str) -> bool:
    """Tell whether words name the thing of a fact: 钥匙, for 我的钥匙."""
    own = re.compile(r"^(?:我们?|咱们?|家里)的?")
    bare, known = own.sub("", said), own.sub("", thing)
    return bool(bare) and (bare == known or known.endswith(bare))


def name_subject(fact: str) -> str:
    """Return the thing whose place a fact tells, folded, without article; empty: it tells none."""
    written = write_plainly(fact).strip(ENDS)
    folded = fold_script(written.lower())
    found = (_SUBJECT_ZH if has_chinese(folded) else _SUBJECT).fullmatch(folded)
    return "" if found is None else _bare(found["a"] or found["b"])


def _bare(words: str) -> str:
    return _ARTICLE.sub("", words).strip()
