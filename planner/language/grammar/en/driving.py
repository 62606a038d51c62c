"""Own the English rules about driving: places, home, waiting, turns, moves, patrols."""

from __future__ import annotations

from re import Match

from planner.language.grammar.clauses import QUOTE
from planner.language.grammar.driving_steps import (
    at_stops,
    come_back,
    drive_into,
    drive_to,
    explore,
    home,
    map_alone,
    move,
    patrol,
    patrol_all,
    route,
    say,
    set_out,
    stand,
    stand_at,
    turn,
    wait,
    wander,
)
from planner.language.grammar.en import GO, THE
from planner.language.grammar.lexicon import MARK
from planner.language.grammar.parse_result import (
    Meaning,
    Reading,
    Rule,
    about,
    lacks,
    on_topic,
    rule,
    unread,
)
from planner.language.grammar.small_talk import Topic
from planner.language.grammar.step_builders import HOW_LONG, WHERE_ARE_YOU, WHERE_TO, missing
from planner.language.numbers import EN_ANGLE, EN_DURATION, EN_LENGTH, TIMES
from planner.plan import Code

_LEAD = (
    r"(?:take|lead|guide|bring|show|escort|accompany|walk|drive) (?:me|us)(?: the way)?(?: back)?"
)
_ORIGIN = (
    r"(?:(?:the |your )?(?:start|starting (?:point|position|place)|origin)"
    r"|where (?:you|we|i) (?:started|were|are|am|are now|began|came from|left)(?: from)?"
    r"|(?:this|the same) (?:place|spot|position))"
)
_DOCK = (
    r"(?:the |your )?(?:(?:charging |docking )?(?:dock|station|point)|charger|base|"
    r"home)(?: station)?"
)
_WHERE = (
    r"where are (?:you|we)(?: (?:now|at|right now|currently|located))?|where is (?:the|my) robot"
    r"|(?:what is|tell me) (?:your|the) (?:current )?(?:location|position)|tell me where you are"
    r"|(?:which|what) (?:room|place|street) (?:are (?:you|we)|am i) (?:in|at|on)|what (?:room|"
    r"place) is this"
    r"|(?:report )?your (?:location|position)|where am i"
)
_PLACES = (
    r"(?:what|which) (?:places|rooms|locations) (?:do you know|are there|can you go to|exist)"
    r"|where can you (?:go|drive)"
    r"|(?:list|show me|tell me|name) (?:all )?(?:the |your )?(?:known )?(?:places|rooms|locations)"
)
_HELP = (
    r"what can you do(?: for me)?|what do you do|help(?: me)?|how can you help(?: me)?|"
    r"what are you able to do"
)
_SIDE = (
    r"(?:to )?(?:the |your )?(?P<side>left|right|clockwise|counter-?clockwise|"
    r"anti-?clockwise)(?: side| hand side)?"
)
_SPIN = r"(?:turn|rotate|spin|pivot|swivel|face)(?: (?:yourself|the robot|in place|on the spot))?"
_TURNS = r"(?P<turns>twice|thrice|(?:two|three|four|five|[2-5]) times)"
_HEAD = r"(?:move|go|drive|walk|come|step|roll|travel|advance)"
_WAY = (
    r"(?:to the )?(?P<way>forwards?|ahead|straight(?: (?:ahead|on|forward))?|backwards?|back|front)"
)
_WHOLE = (
    r"(?:(?:all (?:of )?)?(?:the |my |our |your |this )?(?:whole |entire |rest of the )?"
    r"(?:house|home|flat|apartment|building|place|area|rooms?|floor|surroundings|rest|"
    rf"(?P<place>{MARK}))|everything|everywhere)"
)
_DRAW = r"(?:make|build|draw|create) (?:a|the|your) map"
_ALONE = r"(?:by yourself|on your own|yourself|alone|automatically|autonomously)"


_STAND = r"(?:stand|stop|stay|wait|park(?: yourself)?|position yourself|place yourself|halt)"
_TAKE_PLACE = rf"(?:{_STAND}|{GO}(?: (?:up|to))*)"
_SURE_SIDE = r"(?:in front of|behind|to the (?:side|back|front) of|before)"
_AT_SIDE = rf"(?:{_SURE_SIDE}|at the side of|beside|next to|alongside|by|opposite)"
"""Words for a side; "go next to the sofa" is the place by the sofa that its owner chose."""


def _come_here(found: Match[str], reading: Reading) -> Meaning:
    """Ask where the person is: no camera finds out who spoke."""
    return missing(WHERE_ARE_YOU, found[0], reading)


def _leave(found: Match[str], reading: Reading) -> Meaning:
    return missing(WHERE_TO, reading.marked.restore(found[0]), reading)


def _how_long(found: Match[str], reading: Reading) -> Meaning:
    return missing(HOW_LONG, found[0], reading)


_FINE = (
    r"(?:good|great|nice|fine|excellent|perfect|wonderful|brilliant|awesome|amazing|fantastic|lovely"
    r"|best|clever|smart|sweet|helpful|kind|useful)"
)
TALK: tuple[Rule, ...] = (
    rule(_WHERE, about(Topic.WHERE)),
    rule(_PLACES, about(Topic.PLACES)),
    rule(_HELP, about(Topic.HELP)),
    rule(
        r"(?:describe|introduce|present) yourself|tell (?:me|us) about yourself|what are you",
        about(Topic.SELF),
    ),
    rule(r"(?P<topic>.+)", on_topic),
    rule(
        r"(?:hello|hi|hey|(?:good )?(?:morning|afternoon|evening)|good day|howdy|greetings)"
        r"(?:,? (?:there|robot|pons|again|everyone|all))*",
        about(Topic.HELLO),
    ),
    rule(
        r"(?:good night|(?:good)?bye(?:[ -]bye)?)"
        r"(?:,? (?:then|robot|pons|everyone|all))*",
        about(Topic.BYE),
    ),
    rule(
        r"(?:many )?thanks?(?: you)?(?: (?:very|so) much| a (?:lot|bunch|million)| again)?"
        r"(?: (?:mate|buddy|pal|robot|pons|dear|love|my friend))?|cheers(?: mate)?"
        r"|you(?:'ve)? (?:did|done) (?:(?:so |very |really )?(?:well|great|good|fine)|it)"
        rf"|well done|{_FINE}(?: (?:job|work|robot|boy|girl|stuff|one))?"
        r"|(?:you(?:'re| are)|that(?:'s| is| was)) (?:so |very |really |just )?(?:(?:a|the|an) )?"
        rf"{_FINE}(?: (?:robot|help|job|work|one))?"
        r"|(?:that(?:'s| is| will be|'ll be)|this is) (?:all|it|everything)(?: for (?:now|today))?",
        about(Topic.THANKS),
    ),
)

RULES: tuple[Rule, ...] = (
    rule(rf"{GO} (?:to )?(?:your )?(?:home|base)", home),
    rule(rf"{GO} to {_DOCK}|dock(?: yourself| (?:at|with|in|to) {_DOCK})?", home),
    rule(
        r"(?:go (?:and |to )?)?(?:re)?charg(?:e|ing)(?: (?:yourself|up|(?:your|the) battery))?",
        home,
    ),
    rule(
        r"(?:(?:come|go|get|drive|head|walk|move|return|turn|navigate) )?(?:straight |"
        r"right )?back(?: again)?"
        rf"(?: (?:here|to (?:me|us|{_ORIGIN})))?"
        rf"|return(?: (?:here|to (?:me|us|{_ORIGIN})))?|(?:go|drive|move|walk) to {_ORIGIN}",
        come_back,
    ),
    rule(
        r"(?:wait|stay|pause|remain|stand|hold|rest)(?: still)?(?: (?:here|there|in place))?"
        rf"(?: for)? {EN_DURATION}(?: (?:here|there))?",
        wait,
    ),
    rule(r"(?:stop|wait|stay|remain)(?: there| put)", stand),
    rule(
        r"(?:wait|stay|hang on|hold on)(?: (?:here|there|for (?:me|us|him|her|them)|a bit|a while|"
        r"a moment))?",
        _how_long,
    ),
    rule(rf"(?:say|announce|tell (?:me|us|them|everyone))(?: out loud)? ?(?P<quote>{QUOTE})", say),
    rule(
        r"say (?P<words>(?!something\b|anything\b|nothing\b|(?:it|that|this|so|them)$"
        r"|(?:if|whether|how (?:many|much)|where|who|whose|which|what(?! an?\b))\b)"
        r"[^\ue000-\ue8ff]+?)(?: to (?:me|us|everyone|everybody))?",
        say,
    ),
    rule(rf"{GO} from (?P<start>.+?) (?:to|into|towards?) (?P<place>.+)", route),
    rule(r"(?:(?:start|starting|leave|depart) )?from (?P<place>.+)", set_out),
    rule(rf"(?:start |starting )?from (?P<start>.+?) {GO} to (?P<place>.+)", route),
    rule(rf"{_LEAD} (?:to|towards?|into) (?P<place>.+)", drive_to),
    rule(rf"{_LEAD}", wander),
    rule(
        rf"(?:come|get)(?: (?:over|on))?(?: here| over)|come to (?:me|us)|{GO} to (?:me|us)|come",
        _come_here,
    ),
    rule(
        rf"{_TAKE_PLACE}(?: (?:exactly|about|around))? {EN_LENGTH}"
        rf" (?P<side>{_AT_SIDE}|away from|from) (?P<place>.+)",
        stand_at,
    ),
    rule(rf"{_TAKE_PLACE} (?P<side>{_AT_SIDE}) (?P<place>.+?), {EN_LENGTH}(?: away)?", stand_at),
    rule(rf"{_STAND} (?:right |just )?(?P<side>{_AT_SIDE}) (?P<place>.+)", stand_at),
    rule(rf"{GO} (?:right |just )?(?P<side>{_SURE_SIDE}) (?P<place>.+)", stand_at),
    rule(
        r"(?P<side>(?:turn(?: around)? (?:to (?:face|look at)|towards?)|face(?: towards?)?"
        rf"|turn to)) (?P<place>{THE}{MARK}|(?:the|my|our) (?!left|right|back|front|side)[a-z ]+)",
        stand_at,
    ),
    rule(rf"{_HEAD} {EN_LENGTH}(?: {_WAY})?", move),
    rule(rf"(?:{_HEAD} )?(?:for )?{_WAY}(?: (?:for|by|about))*(?: {EN_LENGTH})?", move),
    rule(rf"(?P<way>reverse|back up)(?: (?:for|by|about))*(?: {EN_LENGTH})?", move),
    rule(rf"{_SPIN} (?:by |about )?{EN_ANGLE}(?: {_SIDE})?", turn),
    rule(rf"spin(?: around| round)? {_TURNS}", turn),
    rule(r"(?P<whole>spin) (?:around|round)", turn),
    rule(
        rf"(?:{_SPIN}|make|do) (?:a )?(?:(?P<quarter>quarter)|(?P<about>half))[ -](?:turn|"
        rf"circle)(?: {_SIDE})?",
        turn,
    ),
    rule(rf"{_SPIN} {_SIDE}(?: (?:by |about )?{EN_ANGLE})?", turn),
    rule(rf"{_SPIN} (?P<about>around|about|round)(?: (?:by )?{EN_ANGLE})?|make a u-?turn", turn),
    rule(
        r"(?:spin|rotate|turn)(?: around)?(?P<whole> (?:once|in (?:a|one) (?:full )?circle|"
        r"a full (?:turn|circle)))",
        turn,
    ),
    rule(
        r"(?:patrol|tour|make (?:a|your) rounds? (?:of|through|in)|do (?:a|your) rounds? (?:of|"
        r"through|in)|"
        r"visit in turn) (?:through |around |in |"
        rf"between )?(?P<place>{THE}{MARK})(?: {TIMES})?",
        patrol,
    ),
    rule(
        r"(?:patrol|tour|visit|go (?:to|through)|check|inspect|make (?:a|your) rounds? of|"
        r"drive through) "
        r"(?:all (?:of )?(?:the )?|every |each |the whole )(?:rooms?|house|home|flat|apartment)"
        r"|patrol (?:the |our |my )?(?:house|home|flat|apartment|building)",
        patrol_all,
    ),
    rule(
        rf"(?:(?:go (?:and )?)?explore|map|(?:start|continue|keep|carry on|go on) exploring)"
        rf"(?: {_WHOLE})?(?: {_ALONE})?",
        explore,
    ),
    rule(
        rf"(?:map|{_DRAW} of) {_WHOLE} {_ALONE}|{_DRAW} {_ALONE}",
        map_alone,
    ),
    rule(
        r"(?:(?:have|take) a (?:good )?(?:look|picture|photo)|look|take (?:pictures|photos))"
        r"(?: a?round)? (?:at|in|of) (?:every|each)(?: single)?"
        r"(?: (?:stop|room|place|one|of them))?"
        r"|(?:tell (?:me|us)|report(?: to (?:me|us))?)(?: back)?(?: (?:at|in) the end)?"
        r" what (?:all )?you (?:saw|see|found|find|noticed|notice)"
        r"(?: where| there| on the way| at (?:every|each)(?: (?:stop|room|place))?)?",
        at_stops,
    ),
    rule(
        r"(?:patrol|wander|roam|explore|cruise|make (?:a|your) rounds?)\b[^\ue000-\ue7ff]*",
        wander,
    ),
    rule(
        r"(?:(?:move|go|drive|walk|come|step|roll|slide) )?(?:a (?:bit|little) )?sideways\b.*",
        lacks(Code.NO_CAPABILITY),
    ),
    rule(
        r"(?:(?:move|go|drive|walk|come|step|roll) )?(?:a (?:bit|little) )?"
        r"(?:left|right|closer|away|in circles?)\b.*"
        r"|turn(?! (?:on|off|up|down|over|out)\b|.* (?:on|off)$)\b.*"
        r"|(?:rotate|spin|reverse|back up|circle|orbit|park)\b.*"
        r"|(?:move|go|drive|walk) (?:for )?(?:about )?(?:back )?\d.*"
        r"|(?:move|go|drive|walk) to the (?:left|right|front)\b.*",
        unread,
    ),
    rule(rf"(?:{GO} (?:into|in|inside)|enter(?: (?:into|to))?) (?P<place>.+)", drive_into),
    rule(
        rf"(?:{GO} (?:to|towards?|at|for|till)|visit|reach|approach|make your way to|"
        r"find your way to|goto|"
        r"stop by|pass by|drop by|swing by) (?P<place>.+)",
        drive_to,
    ),
    rule(rf"{GO} (?P<place>(?:near|next to|by|beside|close to|up to) .+)", drive_to),
    rule(rf"(?:leave|exit|get out of|go out of) {THE}{MARK}", _leave),
    rule(rf"(?:in|at|inside) (?P<place>{THE}{MARK})", set_out),
)
