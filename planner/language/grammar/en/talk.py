"""Own the English words that only talk: questions to the robot, greetings, thanks."""

from __future__ import annotations

from planner.language.grammar.parse_result import Rule, about, on_topic, rule
from planner.language.grammar.small_talk import Topic

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
