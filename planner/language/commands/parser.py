"""Read a whole sentence as something said to the planner itself, or as nothing of the kind.

The stop lane comes before this, a brain after it. A sentence that goes on ("continue to the
kitchen"), is denied ("don't continue") or asks ("continue?") is none of these and is left to the
brain. Same text, same answer; needs no vocabulary and no state.
"""

from __future__ import annotations

import re
import unicodedata
from itertools import islice
from types import ModuleType

from planner.language.commands import chinese, english
from planner.language.commands.command import (
    ENDS,
    QUOTES,
    BatteryCommand,
    CancelCommand,
    Doing,
    Faster,
    FoldedText,
    Forget,
    HereCommand,
    Intent,
    KeepSkill,
    OutcomeCommand,
    PauseCommand,
    Remember,
    Replace,
    ResumeCommand,
    Slower,
    WhereCommand,
    write_plainly,
)
from planner.language.commands.facts import read_fact_order, read_long_fact
from planner.language.commands.statements import find_statement
from planner.language.folding import fold, fold_script, has_chinese
from planner.language.schedule import OrderCommand, ScheduleCommand, read_order_command
from planner.language.stop import is_stop

MAX_READ = 300
"""Characters; a longer sentence is no order to the planner itself."""
MAX_LESSON = 2000
"""Characters; what is to be remembered is understood up to here, so that it can be told how long a
fact may be.
"""
_SIMPLE: tuple[tuple[str, Intent], ...] = (
    ("RESUME", ResumeCommand()),
    ("PAUSE", PauseCommand()),
    ("CANCEL", CancelCommand()),
    ("WHERE", WhereCommand()),
    ("DOING", Doing()),
    ("BATTERY", BatteryCommand()),
    ("OUTCOME", OutcomeCommand()),
    ("SLOWER", Slower()),
    ("FASTER", Faster()),
)
_TIMES = (
    r"o?\d|every|each|daily|nightly|hourly|weekly|week\w*|month\w*|years?|fortnight|morning\w*"
    r"|evening\w*|afternoons?|(?:to)?nights?|noon|midday|midnight|to(?:day|morrow)|yesterday|\w*days?"
    r"|hour\w*|min(?:ute)?s?|sec(?:ond)?s?|o'?clock|half|quarter|time\w*|how long|until|till|later"
    r"|earlier|sooner|soon|before|after|once|moment|when\w*|if|unless|always|never|from now on"
    r"|any ?(?:more|longer)|one|two|three|four|five|six|seven|eight|nine|ten|eleven|twelve"
    r"|first|third|\w+fth|\w*(?:six|seven|nin|ten|elev|twentie|thirtie|teen|eigh)(?:th|enth)"
    r"|january|february|march|april|june|july|august|september|october|november|december"
    r"|dawn|dusk|sun(?:rise|set|down)|breakfast|lunch|dinner|supper|bedtime|christmas|easter|eve"
)
_KEPT = (
    r"re?mind\w*|wake|alarms?|timers?|\w*schedul\w*|standing|recurring|regular\w*|orders?|jobs?|tasks?"
    r"|chores|errands|duties|routines?|rules?|list|agenda|calendar|programme|planned|asked|given"
    r"|keeping|kept|supposed|stop|quit|cancel\w*|drop\w*|pause|skip|remove|delete|forget|scrap\w*"
    r"|ditch|clear|wipe|undo|rid|enough|no more|postpone|delay|snooze|things?|business"
)
_COMES = r"every(?:one|body)|any(?:one|body)|some(?:one|body)|whoever|visitors?|guests?"
_OF_ORDERS = re.compile(rf"(?<![a-z])(?:{_TIMES}|{_KEPT}|{_COMES})(?![a-z])")
_OF_ORDERS_ZH = re.compile(
    r"[\d点时分秒刻天周月年日晚早午夜次每逢号节等再先后前事单活列删停改别撤延挪推跳调换]"
    r"|半|星期|礼拜|钟|睡觉|多久|会儿|圣诞|国庆|元旦|除夕|提醒|记着|贪睡|任务|安排|计划|规矩|吩咐|交代"
    r"|取消|去掉|清[空除掉]|作废|免了|恢复|继续|照[常旧样]|不用|不要"
    r"|如果|要是|假如|万一|一旦|只要|除非|就|有人|看[见到]|没电|客人|来[人访]|[进敲]门"
)
_BEFORE_REASON = re.compile(r"[,;:.!?。]+\s*|\s+[-–—]+\s+|—+| (?:and|then|and then) ")
_SEPARATOR = re.compile(r"[,;:.!。]+\s*|\s+[-–—]+\s+|—+| (?:and|then|and then) ")


def intent_of(text: str) -> Intent | None:
    """Return the command to the planner itself in a sentence, or None."""
    own = _intent_alone(text)
    if own is not None and not isinstance(own, HereCommand):
        return own
    unread = not text.strip() or len(text) > MAX_READ or any(map(_unseen, text))
    timed = not unread and may_concern_orders(text)
    standing = read_order_command(text) if timed else None
    if standing is not None and not _tells_a_time(standing, text):
        return standing  # 在三月五号八点…: no place is called so
    return own


def _tells_a_time(standing: OrderCommand, text: str) -> bool:
    """Tell whether the time is of a statement: "the plumber's coming on Friday at ten"."""
    reminds = isinstance(standing, ScheduleCommand) and standing.reminder is not None
    return (
        isinstance(standing, ScheduleCommand) and not reminds and find_statement(text) is not None
    )


def _intent_alone(text: str) -> Intent | None:
    """Return the command in a sentence that leans on no other."""
    if not text.strip() or len(text) > MAX_LESSON or any(map(_unseen, text)):
        return None
    said = _fold(text)
    if len(text) > MAX_READ:
        grammar = chinese if has_chinese(said.folded) else english
        return read_long_fact(_plain(said.strip(ENDS), grammar), grammar)
    if not has_chinese(said.folded):
        return _read(said, english)
    heard = _read(said, chinese)
    return heard or (_read(said, english) if said.folded[0].isascii() else None)


def _read(said: FoldedText, grammar: ModuleType) -> Intent | None:
    asks = said.folded.rstrip(ENDS).endswith("?")
    said = said.strip(ENDS + "?")
    if grammar.COURTEOUS.match(said.folded):  # "can you continue?" asks for it, not about it
        asks, said = False, said.part(0, len(grammar.ASKING.sub("", said.folded)))
    said = _plain(said, grammar)
    if not said.folded:
        return None
    simple = _simple(said.folded, grammar, asks=asks)
    if simple is not None or asks:
        return simple
    return (
        _read_lesson(said, grammar)
        or read_fact_order(said, grammar)
        or _taking_back(said, grammar)
        or _pausing(said, grammar)
        or _replacing(said, grammar)
        or _slowing(said, grammar)
    )


def _slowing(said: FoldedText, grammar: ModuleType) -> Intent | None:
    """Read "slow down, there is a child": a reason behind it changes nothing."""
    cut = _BEFORE_REASON.search(said.folded)
    if cut is None:
        return None
    first = _plain(said.part(0, cut.start()), grammar).folded
    if grammar.SLOWER.fullmatch(first):
        return Slower()
    orders = grammar.ORDERS.match(said.part(cut.end(), len(said.folded)).folded) is not None
    return Faster() if grammar.FASTER.fullmatch(first) and not orders else None


def _pausing(said: FoldedText, grammar: ModuleType) -> PauseCommand | None:
    """Read "hold on, somebody is at the door": a reason behind it changes nothing."""
    cut = _SEPARATOR.search(said.folded)
    if cut is None:
        return None
    first = _plain(said.part(0, cut.start()), grammar).folded.replace(" ", _gap(grammar))
    rest = said.part(cut.end(), len(said.folded)).strip(ENDS)
    reason = grammar.PAUSE_REASON.fullmatch(rest.folded) is not None
    return PauseCommand() if reason and grammar.PAUSE.fullmatch(first) is not None else None


def _taking_back(said: FoldedText, grammar: ModuleType) -> CancelCommand | None:
    """Read "it's here under my chair, forget it": a reason before it changes nothing."""
    cuts = list(_SEPARATOR.finditer(said.folded))
    if not cuts:
        return None
    last = _plain(said.part(cuts[-1].end(), len(said.folded)), grammar).folded
    reason = _plain(said.part(0, cuts[-1].start()), grammar).folded
    cancels = grammar.CANCEL.fullmatch(last.replace(" ", _gap(grammar))) is not None
    return CancelCommand() if cancels and grammar.ORDERS.match(reason) is None else None


def _unseen(char: str) -> bool:
    """Return whether a sentence has characters that show a person another sentence."""
    return unicodedata.category(char) in ("Cc", "Cf", "Cs", "Co") and char not in "\t\n\r"


def _fold(text: str) -> FoldedText:
    written = write_plainly(text)
    folded = written.lower()
    if len(folded) != len(written):  # a few letters grow in lower case
        written = folded
    return FoldedText(fold_script(folded), written)


def _plain(said: FoldedText, grammar: ModuleType) -> FoldedText:
    """Take the courtesy off both ends."""
    while True:
        before = said
        if (found := grammar.POLITE.match(said.folded)) and found.end() < len(said.folded):
            said = said.part(found.end(), len(said.folded)).strip(ENDS)
        if (found := grammar.THANKS.search(said.folded)) and found.start() > 0:
            said = said.part(0, found.start()).strip(ENDS)
        if said == before:
            return said


def _simple(folded: str, grammar: ModuleType, *, asks: bool) -> Intent | None:
    words = re.sub(r"[\s,]+", "" if grammar is chinese else " ", folded).strip()
    for name, intent in _SIMPLE:
        if getattr(grammar, name).fullmatch(words) is not None:
            question = isinstance(intent, (WhereCommand, Doing, BatteryCommand, OutcomeCommand))
            return None if asks and not question else intent
    return None


def _read_lesson(said: FoldedText, grammar: ModuleType) -> Intent | None:
    """Read the name that is to be remembered or forgotten, or where the robot is said to be."""
    kinds: tuple[
        tuple[str, type[KeepSkill] | type[Remember] | type[Forget] | type[HereCommand]], ...
    ] = (
        ("KEEP_SKILL", KeepSkill),
        ("REMEMBER", Remember),
        ("FORGET", Forget),
        ("HERE", HereCommand),
    )
    for pattern, kind in kinds:
        found = getattr(grammar, pattern).fullmatch(said.folded)
        if found is None:
            continue
        group = next(name for name, text in found.groupdict().items() if text is not None)
        name = _name(said.part(*found.span(group)))
        return None if name is None else kind(name)
    return None


def _name(said: FoldedText) -> str | None:
    """Return a name without quotes and determiners, or None where the words are no name."""
    said = said.strip(" " + QUOTES + ENDS)
    grammar = chinese if has_chinese(said.folded) else english
    found = grammar.DETERMINER.match(said.folded)
    if found is not None:
        said = said.part(found.end(), len(said.folded))
    if not said.folded or grammar.NO_NAME.fullmatch(said.folded):
        return None
    return said.written


def _replacing(said: FoldedText, grammar: ModuleType) -> Intent | None:
    """Read "forget that, come here" and "go to the kitchen instead"."""
    found = grammar.INSTEAD.fullmatch(said.folded)
    if found is not None:
        group = "rest" if found["rest"] is not None else "rest2"
        return _replace(said.part(*found.span(group)), now=False)
    bare = grammar.UNPUNCTUATED.match(said.folded)
    if bare is not None:
        return _replace(said.part(bare.end(), len(said.folded)), now=True)
    for cut in islice(_SEPARATOR.finditer(said.folded), 2):  # behind a courtesy at most
        first = _plain(said.part(0, cut.start()), grammar)
        order = said.part(cut.end(), len(said.folded)).strip(ENDS)
        put_off = said.part(0, cut.start()).strip(ENDS).folded  # "now" is no courtesy here
        if grammar.POSTPONED.fullmatch(put_off) and grammar.COMES_FIRST.match(order.folded):
            return _replace(order, now=True)
        if grammar.TAKEN_BACK.fullmatch(first.folded.replace(" ", _gap(grammar))):
            rest = said.part(cut.end(), len(said.folded)).strip(ENDS)
            cancels = grammar.CANCEL.fullmatch(first.folded.replace(" ", _gap(grammar)))
            if cancels and grammar.REASON.fullmatch(rest.folded):
                return CancelCommand()
            if grammar.DENIES.fullmatch(first.folded) and _goes_on(said, cut, grammar):
                return None
            return _replace(_without_reason(rest, grammar), now=True)
    return None


def _without_reason(rest: FoldedText, grammar: ModuleType) -> FoldedText:
    """Return an order without the clause before it that says why another is taken back."""
    cut = _SEPARATOR.search(rest.folded)
    reason = _plain(rest.part(0, cut.start()), grammar) if cut is not None else None
    if cut is None or reason is None or grammar.REASON.fullmatch(reason.folded) is None:
        return rest
    return _plain(rest.part(cut.end(), len(rest.folded)).strip(ENDS), grammar)


def _goes_on(said: FoldedText, cut: re.Match[str], grammar: ModuleType) -> bool:
    """Tell whether a clause is joined to the next: then "don't" may well mean both."""
    joined = said.folded[cut.start() :].lstrip(ENDS)
    return grammar.GOES_ON.match(joined) is not None


def _gap(grammar: ModuleType) -> str:
    return "" if grammar is chinese else " "


def _replace(rest: FoldedText, *, now: bool) -> Intent | None:
    """Take the rest as the new order; where it is none by itself, leave all to the brain."""
    rest = rest.strip(ENDS)
    if not any(map(str.isalnum, rest.folded)):
        return None
    if not is_stop(rest.written) and intent_of(rest.written) is not None:
        return None  # "never mind, continue": whichever is meant, a person must say
    return Replace(rest.written, now)


def may_concern_orders(text: str) -> bool:
    """Return whether anything in a sentence may be of a standing order: a time, a guest, a kind.

    It costs little, and is asked before any form of theirs is tried.
    """
    pattern = _OF_ORDERS_ZH if has_chinese(text) else _OF_ORDERS
    return pattern.search(fold(text)) is not None
