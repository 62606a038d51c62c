"""Own the English words that stop a robot, and the words around them that mean something else.

Patterns alone, for stop.py: searched in a whole sentence whose clauses are divided by `` , `` and
whose misspelt stop words were mended. The clauses that order a stop by themselves stand in
stop_english_orders.py.
"""

from __future__ import annotations

import re


def _compile_any(*patterns: str) -> re.Pattern[str]:
    # Each begins at a word or a comma: asking that first spares trying all within words.
    return re.compile(rf"(?<![a-z0-9])(?:{'|'.join(patterns)})")


# Clear other meanings ---------------------------------------------------------------------------

_T = r"(?:stop|halt|freeze|brake|abort|cease|quit|pause)"
_START = (
    r"(?:^|, (?:and |but |so |then )?|\b(?:and|but|please|so|just|or|ok|okay|robot|hey|oh|go|on"
    r"|ahead|going|driving|moving|then|now) )"
)
_ROBOT = (
    r"(?:robot|thing|machine|car|cart|it|this|that|you|yourself|wheels?|motors?|vacuum|trolley)"
)
_BODY = r"(?:the|my|his|her|our|your|their|this|that|a|an|those|these|some|all|every)"
_THIRD = (
    rf"(?:him|her|them|everyone|everybody|people|{_BODY} (?!(?:\w+ )?{_ROBOT}\b)\w+(?: \w+)?"
    r"|mom|mum|dad|mummy|daddy|grandma|grandpa)"
)
_SAY = r"(?:say|shout|yell|announce|call out|whisper|read(?: out)?|write|type|spell|sing|repeat)"
_SAYS = r"(?:said|says|shouted|shouts|yelled|yells|screamed|told (?:me|him|her|them|us)(?: to)?)"
_SUBJECT = r"(?:you|it|he|she|they|we|i|someone|somebody|the \w+)"
_SOMEBODY = r"(?:i|we|he|she|they|someone|somebody|anyone|you)"
_LATER = r"(?:see|reach|get|arrive|find|come|meet|detect|finish|pass|have|are at|notice)"
_MEDIA = r"(?:music|song|video|movie|film|noise|alarm|timer|sound|radio|tv|television|recording)"
_IN = r"(?:at|by|near|next to|beside|behind|in front of|inside|in|on|opposite|close to)"
_NO_PLACE = r"(?:way|path|spot|place|moment|point|name|count|instant|minute|second|tracks?|dot)"

ELSE = _compile_any(
    # a thing of that name
    rf"(?<!put )(?<!to )(?<!into )(?<!this )\b(?:bus|tram|train|metro|subway|coach|taxi|truck|rest"
    rf"|pit|door|next|first|last|final|the|a|an|my|your|our|any|each|every|which|what|whistle) {_T}"
    r"s?\b(?<!brake)(?<!brakes)(?! (?:it|moving|driving|now|please)\b)",
    r"(?:\b(?:check|test|fix|mend|about|hear|are|is|of|with|has|have|need|change|inspect) "
    r"(?:the |your |my |its |a |new )*brakes?\b)",
    rf"\b(?:e )?{_T} (?:sign|button|light|line|valve|watch|word|knob|switch|key|pad|bar|motion"
    r"|pedal|list|frame)s?\b",
    rf"\b(?:non|one) {_T}\b",
    # denied as an order, or told of somebody else
    rf"{_START}(?:you (?:must|should|may|can|need|have) )?(?:do not|never|not|must not|should not"
    r"|can not|need not|no need to)(?: (?:ever|you|even|just|dare|please|to|try to|have to|need to"
    rf"|let \w+))* {_T}\b",
    r"\b(?:do|did) not (?:want|need|say|mean|tell|ask)(?: (?:you|it|him|the robot))?(?: to)?"
    rf" {_T}\b",
    rf"\byou (?:do not|need not) (?:have to|need to) {_T}\b",
    rf"\bno (?:reason|need|point) (?:to|in) {_T}\b",
    rf"\b(?:who|nobody|no one) (?:said|says|told|asked)(?: you)?(?: to)? {_T}\b",
    rf"\b{_BODY} (?!{_ROBOT})(?:\w+ )?\w+ (?:does|did|do|would|will|could|can) not {_T}\b",
    # words to be said, or said by others
    r"(?:^|, |\b(?:and|then|please|can you|could you|will you|would you|to) )(?<!have to )"
    rf"(?<!need to )(?<!had to ){_SAY}(?: (?:the|words?|out|loud|aloud|loudly))* {_T}\b",
    rf"\bwords? {_T}\b|\b(?:called|titled|named) {_T}\b",
    r"(?<!one )(?<!body )\b(?:tell|ask|order|remind|make|let|get|have|help|teach|allow)"
    rf" {_THIRD}(?: to)? {_T}\b",
    rf"\b(?:he|she|they|(?:somebody|someone|anyone)(?: else)?|the (?!{_ROBOT})\w+)"
    rf"(?: (?:always|just|never|once))? {_SAYS} {_T}\b",
    rf"\b(?:heard|hear) \w+ (?:say|shout|yell|scream) {_T}\b|\b\w+ always {_SAYS} {_T}\b",
    rf"\b(?:when|until|till|if|once|after|unless|before|whenever) {_SOMEBODY} (?:says?|shouts?"
    rf"|yell|tells? you|hear|ask)(?: you)?(?: to)?(?: the)? {_T}\b"
    r"(?! ,? ?(?:i mean|you|that means))",
    # questions
    rf"\bwhy (?:did|do|does|would|are|is|have|has) {_SUBJECT}(?: (?:always|just|suddenly|keep|ever"
    rf"|even|have to|need to))* {_T}\b",
    rf"\b(?:when|where) (?:did|do|does|would|should) {_SUBJECT}(?: (?:last|usually|normally|first"
    rf"|next|always|have to))* {_T}\b",
    rf"\bhow (?:long|far|fast|quickly|well|soon|much)\b[^,]* {_T}\b",
    rf"\bwhat (?:happens|does|time|would happen|will happen)\b[^,]* {_T}\b",
    rf"\bwhich \w+ (?:makes?|made|lets?)\b[^,]* {_T}\b",
    rf"\bdid {_SUBJECT}(?: (?:just|ever|really|already|have to))* {_T}\b",
    rf"\bnothing can {_T}\b|\b(?:tends?|tended|used) to {_T}\b",
    # a place or a moment that is still to come
    rf"\b{_T} (?:right )?{_IN} (?:{_BODY}|each) (?!{_NO_PLACE}\b)\w+",
    rf"\b{_T} (?:there )?(?:when|once|as soon as|whenever) (?:you|we|it) {_LATER}\b",
    r"\b(?:when|once|as soon as|next time|after|every time|each time|whenever|if) (?:you|we|it)"
    rf" (?:have )?{_LATER}\b(?! (?:near|closer?|me)\b)[^!?]*?\b{_T}\b",
    # another activity
    rf"\b{_T} (?:talking|speaking|singing|beeping|playing|asking|saying|repeating|recording"
    r"|shouting|laughing|crying|waiting|worrying|smoking"
    rf"|(?:the|that|this|your|all that|all the) {_MEDIA})\b",
    r"\bfreeze (?:up|the)\b",
)
"""A stop word in a clear other meaning."""

_FOR = r"for (?!me\b|us\b|a (?:sec|second|minute|moment|bit)\b|god|good|heav|pity|cry)"
_BEGINS = (
    r"(?:go(?! away)|drive|move|come(?! on)|head|walk|run|roll|navigate|travel|return|bring|fetch"
    r"|take(?! it easy)|find|look(?! out| ,)|search|seek|locate|count|follow|guide|lead|escort"
    r"|accompany|patrol|visit|check|tell|say|ask|announce|describe|turn(?! off| yourself| it off)"
    r"|rotate|spin|back(?! off)|reverse|greet|introduce|meet|answer|deliver|clean|open|show|explore"
    r"|inspect|enter|approach|carry|keep (?:going|driving|moving)|continue|resume|read"
    r"|see (?:if|what)|wait (?:(?:here|there) (?:for(?! (?:me|us)\b)|until|till|and)|in|at|by"
    rf"|until|till|\d|{_FOR})"
    r"|stay (?:in|at|with|near|by)"
    r"|get (?:to|me|the)|proceed|remember|learn|start|begin|drop by|swing|pop|step|give (?!it|up)"
    r"|play|speed up"
    r"|(?:once|when|as soon as|after) (?:you|we) (?:have )?(?:see|reach|get|arrive|find"
    r"|come|finish|are)(?! (?:near|close)))"
)
_POLITE = (
    r"(?:,[ ,]*)?(?:(?:please|pls|hey|hi|ok|okay|robot|pons|now|so|then|first|and|just|can you"
    r"|could you|would you|will you|i want you to|i need you to|i would like you to|you should"
    r"|let us|kindly)[ ,]*)*"
)
"""One way to read each text: a comma that is also a word of its own doubles the ways with each, and
23 times "and, " took the stop lane a minute."""
PLAN = re.compile(rf"^{_POLITE}{_BEGINS}\b")
"""A sentence that begins as an order to do something: in it only true stop words count."""
_ASKS = r"(?:what|where|who|which|how (?:many|much|long|far)|is|are|do you|did|has|have)"
PLAN_WITHIN = re.compile(rf"(?:^|, |\band (?:then )?){_POLITE}(?:{_BEGINS}|{_ASKS})\b")
"""A clause, first or later, that orders or asks something."""
_SOMEWHERE = (
    r"\b(?:to|into|towards?|through|past|along|forwards?|backwards?|back|straight|left|right|around"
    r"|met(?:re|er)s?|degrees?|me|\d+|him|her|them|round|down|up|until|the)\b"
)
ENDS_IN = re.compile(
    rf"^{_POLITE}{_BEGINS}\b(?!.*\bnot\b)(?=.*{_SOMEWHERE}).*?(?:\band(?: then)?|\bthen|, then"
    rf"|, and(?: then)?) {_T}(?: (?:there|here))?(?: (?:for|at|in|by|near|next|beside|and|when|if"
    r"|until|once|before)\b.*)?$"
)
"""An order to go somewhere that ends with standing there: "go to the kitchen and stop"."""

# What stops -------------------------------------------------------------------------------------

STRONG = _compile_any(
    r"\b(?:s+t+[ao]+[hw]*p+|h+a+l+t+|f+r+e+e*z+e+|brakes?|who+a+h?|wo+a+h?|abort|desist|cease)\b",
    r"\b(?:e ?stop|standstill|quit|avast|stationary|motionless)\b",
    r"\b(?:do not|must not|to not|not to|never) (?:you |dare |even |ever |please |to )*"
    r"(?:move|budge|stir|twitch)\b(?! (?:to|into|the|my|this|that|from|it|towards?|away from)\b)",
    r"\bting ?(?:xia(?: ?lai)?|zhi|che|ba|le|yi ?xia)\b|\bbie ?dong\b|\bzhan ?zhu\b|^(?:ting ?)+$",
    r"\bno (?:further|farther|closer|nearer)\b|\b(?:mind|consider|start|try) stopping\b",
    r"\b(?:stand(?:ing)?|hold(?:ing)?|stay(?:ing)?|keep(?:ing)?|sit|remain|be|stood)"
    r" (?:completely |perfectly |very |absolutely )?still\b",
    r"\b(?:please|just|now|robot|no)*stop(?:now|it|please|moving|robot|that|there|right|the|all|pls"
    r"|stop)+\b",
)
"""Words that stop wherever they stand, unless they clearly mean something else."""
_FILLERS = r"(?:(?:you|ever|even|just|dare|to|please|all|now|think of|any) )*"
_MOVING = (
    r"(?:mov(?:e|ing)|budg(?:e|ing)|go(?:ing)?|com(?:e|ing)|driv(?:e|ing)|approach|continu(?:e|ing)"
    r"|proceed|advance|roll(?:ing)?|turn|touch|hit|run|carry on|keep|back|get|take|step|try|dare"
    r"|do (?:that|this|it)|start|leave|let it)"
)
_ANY_VERB = (
    r"(?!stop|halt|pause|quit|wait|forget|worry|hesitate|freeze|brake|give up|mind|be|tell|say|ask"
    r"|let|know|look like|understand|you think)\w+"
)
_CALLS = (
    r"(?:(?:please|robot|hey|no|oh|uh|just|ok|okay|now|right|well|good|and|you|dude|can|could|would"
    r"|will|must|should|have to|need to|i said|i want|to|let us) )*"
)
_END = r"(?: ,|$| now| please| i said| right| boy| robot| there)"
DENIAL = _compile_any(
    rf"\b(?:do not|never|must not|should not|can not|not to|no|not) {_FILLERS}{_MOVING}\b"
    r"(?! (?:so |too |that )*slow)",
    rf"(?:^|, ){_POLITE}(?:i (?:do|said do) not want you to|do not|never"
    rf"|you (?:must|should|can|do) not) {_FILLERS}{_ANY_VERB}(?! (?:so |too |that )*slow)",
    r"(?:^|, )(?:please |no |actually |oh |wait |hey |robot |just )*do not(?: ,|$)"
    r"|\bno you do not\b",
    r"\bnot (?:one|another|an|a) (?:more |single )?(?:\w+ )?(?:inch|step|move|met(?:re|er)|foot"
    r"|centimet(?:re|er)|millimet(?:re|er)|word|bit)\b",
    r"(?:^|, )(?:no |oh )*not (?:now|here|there|yet|that|the|my|on|so|again|this|near|any|over)\b",
    r"\bno (?:further|farther|closer|nearer|more)\b|\bas far as (?:you|it) (?:go|goes|get|gets)\b",
    r"\b(?:not a|another|one more|single) (?:\w+ )?(?:hair|whisker|step|inch|fraction|smidge)\b",
    r"\bplant yourself\b|\b(?:that|this|it) will do\b|\b(?:there|here) is (?:fine|good|far|okay)\b",
    r"\bwe are done\b|\byou are done\b|\bsettle down\b|\bcalm down\b|\bsimmer down\b",
    r"\b(?:too|so) (?:close|near)\b|\b(?:far|close|near) enough\b",
    rf"(?:^|, ){_CALLS}(?:that is |that was |it is |i said )?(?:quite |really |more than |about )?"
    r"enough\b(?! (?:\w+ )?(?:to|for|milk|time))",
    # holding, staying, waiting
    r"\bhold (?:it|up|on|position|your|everything|there|right there|back|steady|fast|off|now)\b",
    rf"(?:^|, ){_CALLS}(?:hold|stand|sit|heel|park|cut|whoops|down){_END}",
    r"\bstay (?:right |just |exactly )?(?:there|put|where|here|back|away|down|as you are|off)\b",
    rf"(?:^|, ){_CALLS}stay(?: stay)*{_END}",
    r"\b(?:remain|wait) (?:right |just |exactly )?(?:there|where you|here|put)(?: ,| please| now|$"
    r"| you| for (?:me|us)\b"
    r"| (?:just )?(?:a|one|half a) (?:sec|second|minute|moment|mo|tick|bit)\b)"
    r"|\b(?:remain|stay|wait|stand|hold) (?:right )?where you are\b",
    r"(?<!to )(?<!do you )(?<!i )\bwait\b(?! (?:here|there|in|at|by|until|till|outside|inside|near"
    r"|with|\d|two|three|four|five|six|seven|eight|nine|ten|fifteen|twenty|thirty|forty|fifty"
    r"|sixty"
    rf"|{_FOR}))",
    r"\bh[ao]ng (?:on|about|fire|back)\b|\bhold on\b|\bstand ?by\b|\bgive over\b|\bleave off\b",
    rf"(?:(?:^|, ){_CALLS}(?:a|one|half a|gimme a|give me a)|\bjust (?:a|one))"
    r" (?:sec|second|minute|moment|mo|tick|break|bit(?= ,|$))\b",
    r"\btime ?out\b|\btake (?:a|five|5) ?(?:break|breather|rest)?$|\bsuspend\b|\bpause\b",
    r"\bstand (?:down|back|there|right there|where|aside|fast|clear)\b|\bstay clear\b"
    r"|\bmake stand\b",
    r"\b(?:nobody|everybody|everyone|no one) (?:move|moves|freeze|stand)\b",
    # off, away, over
    r"\b(?:cut|knock|pack|call|give|turn|shut|switch|power|kill|end|drop|leave|quit|park|nix)"
    r" (?:it|this|that|yourself|everything|the thing)(?: (?:out|off|in|up|down|a rest|be|alone"
    rf"|there|right there)\b|{_END}| or| before| at| and)",
    r"\b(?:kill|cut|disable|disengage|switch off|turn off|shut off|shut down|power down|stall|lock"
    r"|unplug|deactivate) (?:the |your |all |that |its |this )*(?:power|engines?|motors?|wheels?"
    r"|drives?|motion|movement|robot|machine|system|thing|current|ignition)\b",
    r"\b(?:shut|power|turn|switch) (?:yourself )?(?:down|off)(?: ,|$| now| please| right)",
    r"\b(?:motors?|engines?|power|drive|wheels|everything) off\b|(?:^|, )off(?: ,|$| now)",
    r"\bkill switch\b|\bpull (?:over|up)\b|\bback off\b|\b(?:get|keep) (?:off|back|away)\b",
    r"\b(?:cut|pack|can) it\b|\bchill(?: out)?$|\bcool it\b|\bred light\b|\b(?:drop|cast) anchor\b",
    r"\beasy(?: ,|$| boy| there| now| does)|\bsteady(?: ,|$| on| there)|\bdisengage\b|\bbelay\b",
    r"\b(?:come|coming|get|put|bring|skid|grind|roll|slow)\b[^,]* (?:to )?(?:an? |the )?(?:\w+ )?"
    r"(?:stop|halt|standstill)\b",
    r"\bput (?:an? (?:stop|end) to|[^,]* in park)\b|\bin neutral\b|\bcalling it off\b",
    r"\b(?:drop|end|finish|terminate|interrupt|scrub|scrap|scratch|cancel|abandon|kill)"
    r" (?:the|this|that|your|my|all|it|what|everything)\b",
    r"\b(?:call off|cancel|terminated?|disarm)\b|\bchanged my mind\b|\bdo not bother\b",
    r"\bnever ?mind\b|\bforget (?:it|that|about|the|this)\b",
)
"""Words that stop in a sentence that does not begin as an order to do something."""
DENIAL_WORDS = frozenset(
    {
        *(
            "far",
            "another",
            "single",
            "plant",
            "yourself",
            "will",
            "there",
            "here",
            "done",
            "settle",
        ),
        *("calm", "simmer"),
        *(
            "not",
            "never",
            "no",
            "close",
            "near",
            "enough",
            "hold",
            "stand",
            "sit",
            "heel",
            "park",
            "cut",
            "whoops",
            "down",
            "stay",
            "remain",
            "wait",
            "hang",
            "hong",
            "standby",
            "give",
            "leave",
            "time",
            "timeout",
            "take",
            "suspend",
            "pause",
            "nobody",
            "everybody",
            "everyone",
            "knock",
            "pack",
            "call",
            "turn",
            "shut",
            "switch",
            "power",
            "kill",
            "end",
            "drop",
            "quit",
            "nix",
            "disable",
            "disengage",
            "stall",
            "lock",
            "unplug",
            "deactivate",
            "off",
            "pull",
            "back",
            "get",
            "keep",
            "can",
            "chill",
            "cool",
            "red",
            "cast",
            "easy",
            "steady",
            "belay",
            "come",
            "coming",
            "put",
            "bring",
            "skid",
            "grind",
            "roll",
            "slow",
            "neutral",
            "finish",
            "terminate",
            "terminated",
            "interrupt",
            "scrub",
            "scrap",
            "scratch",
            "cancel",
            "abandon",
            "disarm",
            "calling",
            "mind",
            "nevermind",
            "forget",
            "changed",
            "bother",
            "sec",
            "second",
            "minute",
            "moment",
            "mo",
            "tick",
            "bit",
            "break",
            "make",
        ),
    }
)
"""One of these stands in every sentence that DENIAL finds something in: asked first, for speed."""
SOFT = _compile_any(
    r"\b(?:watch|look) (?:out|it)(?! (?:of|the window|for)\b)|\bwatch (?:where|your)\b",
    r"\bbe careful\b|(?:^|, )careful\b|\bheads up\b|\bdanger\b|\bmind (?:the|my|your|out)\b",
    r"\b(?:about|going|gonna|almost|nearly|you will|you would|you are) (?:to |just )?(?:hit|crash"
    r"|run over|crush|fall|bump|smash|knock|go|drive|roll|tip|tumble|bang|break|hurt)\w*\b",
    r"\byou (?:are )?(?:on|hurting|too|hit|hurt|ran over|almost|crushing|scaring|squashing|dragging"
    r"|stuck|frightening|standing on)\b",
    r"\bmy (?:foot|feet|toes?|hand|fingers?|leg|dress|tail|cable)\b",
    r"\bunder (?:the|your) wheels?\b|\bin (?:the|your|my) (?:way|path)\b|\bwrong way\b",
    r"\b(?:right now|right this|this (?:second|instant|minute|very)|immediately|at once|right away"
    r"|instantly|or else)\b",
    r"(?:^|, )(?:(?:this|it|here|there) is )?(?:an? )?emergency(?=$| ,)",
)
"""Warnings and urgency: they stop where no clause of the sentence orders something."""
