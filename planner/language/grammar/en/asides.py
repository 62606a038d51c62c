"""Own the English words of asides: courtesy, praise, checks, and statements of how things stand."""

from __future__ import annotations

import re

from planner.language.grammar.aside_forms import AsideForms
from planner.language.grammar.lexicon import MARK

_WHO = (
    r"(?:robot|robo|pons|mate|buddy|pal|love|dear|darling|honey|sweetie|sweetheart|friend|my friend"
    r"|lad|boy|girl|chap|old (?:chap|boy|thing)|champ|chum|bud|dude|man|sir|everyone|all"
    r"|little (?:one|guy|fella|fellow|buddy|robot|friend))"
)
_ADDRESS = rf"(?:[ ,]+(?:my )?(?:dear |little )?{_WHO})?"
_FINE = (
    r"(?:good|great|grand|lovely|nice|kind|sweet|wonderful|brilliant|perfect|ace|super|helpful|fine"
    r"|ideal|smashing|fab(?:ulous)?|fantastic|appreciated|swell|handy|useful)"
)
_VERY = r"(?:(?:so|ever so|very|really|most|too|such|just|dead|all|quite|that|always) )*"
_DARLING = (
    r"(?:love|dear|darling|star|angel|gem|hero|legend|treasure|champ|champion|pet|sweetheart|sport"
    r"|lad|boy|girl|robot|helper|machine|thing|one|friend|mate|soul|lamb|poppet|duck|best|marvel"
    r"|lifesaver|peach|doll|saint)"
)
_ADJ = r"(?:(?!not\b|no\b|never\b)[a-z]+ ){0,2}"
_THANKS = (
    r"(?:many |much )?(?:thanks|thank you|ta|cheers|obliged|bless you|god bless(?: you)?"
    r"|much obliged|bless your (?:heart|cotton socks|wheels))"
    r"(?: (?:ever so|so|very|awfully))?(?: (?:much|a lot|a million|a bunch|a ton|loads|kindly))?"
    r"(?: in advance)?"
)
_MOMENT = r"(?:a|one|the|some|any) (?:moment|minute|min|sec|second|chance|time|tick)"
FAVOUR = (
    r"(?:(?:can|could|would|will) you )?(?:do|doing) (?:me|us) (?:a|one|this) (?:[a-z]+ )?"
    r"(?:favou?r|solid|kindness)"
)
_SORRY = (
    r"(?:i am |i'm )?(?:so |very |terribly |awfully |really )?sorry(?: (?:to|for) (?:bother|trouble"
    r"|disturb|interrupt|ask|be a (?:pain|bother|nuisance)|bothering|troubling|disturbing|asking)"
    r"(?: you)?(?: (?:again|with this|like this))?)?"
    r"|i hate to (?:ask|bother you|trouble you|be a (?:bother|pain|nuisance))"
    r"|(?:excuse|pardon|forgive) me(?: for asking)?"
    r"|i know (?:you are|you're) (?:very |really )?(?:busy|tired|resting|sleeping|charging)"
)
BE = rf"(?:(?:can|could|would|will) you )?(?:please )?be (?:a|an|my) {_ADJ}{_DARLING}"
_PRAISE = (
    rf"{_THANKS}{_ADDRESS}"
    rf"|(?:you(?: are|'re)?|there(?: is|'s)|what|such) ?(?:a|an|the|my) ?{_ADJ}{_DARLING}"
    rf"|(?:good|great|clever|sweet) {_DARLING}|(?:good (?:on|for) you|well done){_ADDRESS}"
    r"|(?:that|it|this)(?:'s| is| was|'ll do| will do)? (?:so |really |very |dead |just )*"
    rf"{_FINE}|perfect|lovely|great|brilliant|(?:are not|aren't) you [a-z]+"
)
_FORMULAS = (
    rf"(?:good )?(?:morning|evening|afternoon|day){_ADDRESS}",
    rf"(?:hello|hi|hey|hiya|howdy)(?: there| again)?{_ADDRESS}",
    rf"{_THANKS}{_ADDRESS}",
    rf"(?:my )?(?:dear )?{_WHO}",
    r"please(?: and thank you)?|pretty please|pleasure|with pleasure",
    rf"(?:you(?: are|'re)?|there(?: is|'s)|what|such|like|my|that(?: is|'s))(?: {_VERY}?)?"
    rf" ?(?:a|an|the|my|you)? ?{_ADJ}{_DARLING}",
    rf"(?:good|great|clever|sweet|brave) {_DARLING}|good (?:on|for) you|well done",
    r"(?:are not|aren't) you (?:a |an |the |just |so |such a )*[a-z]+(?: [a-z]+)?",
    FAVOUR,
    BE,
    r"i (?:just )?(?:need|have|want|would like) (?:a|one) (?:little |small |quick |big )?"
    r"(?:favou?r|request|thing)(?: (?:to ask|from you|of you|for you))?",
    _SORRY,
    rf"(?:that|it|this)(?:'d| would|'ll| will|'s| is) (?:be )?{_VERY}{_FINE}(?: of you| thanks)?",
    rf"would be {_VERY}{_FINE}(?: of you)?",
    r"i(?:'d| would|'ll| will)? (?:really |much |so )?(?:appreciate it|be (?:ever so |so |very |most )?"
    r"(?:grateful|glad|thankful|obliged|happy|pleased))",
    r"(?:there is |there's )?no (?:rush|hurry|worries|pressure|panic)(?: at all)?"
    r"|take your time|in your own (?:sweet )?time|easy does it|at your leisure",
    rf"(?:when|whenever) you(?:'ve got| have got| have| get|'ve) {_MOMENT}",
    r"as (?:usual|always|ever|ever was)|for (?:a change|once|me|us|now|old times'? sake)",
    r"that(?: is|'s)? (?:all|it|everything)|nothing (?:else|more)",
    r"if (?:that|it)(?: is|'s) (?:ok|okay|all right|alright|fine)(?: (?:with|by|for) you)?"
    r"|if (?:it|that)(?: is|'s) not too much (?:trouble|bother|hassle)(?: for you)?",
    r"(?:as )?quick as you can|quick (?:sharp|smart)|chop chop|look sharp|snap to it",
    r"(?:do|can|did) you (?:hear|understand|read|follow|get) (?:me|that|it|this)|you hear(?: me)?"
    r"|understood|got (?:it|that|me)|is that clear|clear|yeah|yes|right|ok(?:ay)?|alright|eh|innit"
    r"|would you mind|do you mind|if you (?:do not|don't|would not|wouldn't) mind",
    r"(?:are )?you (?:there|awake|up|ready|listening|ok(?:ay)?|all right|alright|well|busy|free|with me)",
    r"how (?:are|is) (?:you|things|it going|your day)(?: (?:doing|going|today|this morning|then))*",
    r"(?:have you had|did you have|are you having|having|had) (?:a|an) [a-z]+(?: [a-z]+)?"
    r"(?: (?:today|so far))?",
    r"did you (?:sleep|rest|charge)(?: (?:well|ok|okay|all right|alright))?",
    r"(?:is not|isn't|what) (?:it |that )?(?:a|such a|just) [a-z]+ (?:day|morning|evening|afternoon)",
    r"let me (?:think|see)(?: now)?|you know(?: what)?|i mean it|to be honest|honestly|here(?: is|'s) the thing"
    r"|listen(?: up)?|look here|guess what|as i (?:said|say)|oh (?:dear|my|boy|well|my god|no matter)"
    r"|(?:oh )?my (?:back|feet|legs|head|poor [a-z]+|goodness)|bother|blast|crikey|blimey|gosh",
    r"(?:it|this) (?:will not|won't|should not|shouldn't) take (?:long|a (?:minute|moment|second|sec))",
    r"(?:do not|don't) (?:worry|fret|mind|fuss)(?: (?:about|yourself|me|us|over|for)(?: [a-z]+){0,3})?",
    r"sorry|(?:i (?:bet|reckon|think|guess|am sure|expect) )?there(?: (?:should|ought to|must|will|has to|(?:might|may)"
    r"(?= (?:still )?be (?:one|some|more|two|three|several)\b))(?: still)? be| is bound to be|'ll be) (?:(?!not\b|no\b|none\b)[a-z]+|\d+)(?: of (?:them|[a-z]+))?"
    r"(?: left)?(?: lying)?(?: around| about)?(?: somewhere)?(?: in there)?",
    r"(?:i (?:bet|reckon|guess|imagine|suppose|expect|am sure|am afraid|hope|fear)|surely|probably)(?: that)?"
    r" there(?: is|'s| are|'ll be| will be) (?:loads|lots|plenty|tons|heaps|hundreds|millions|quite a few|a few|some"
    r"|a lot|too many|enough|one)(?: of (?:them|[a-z]+))?(?: left)?(?: lying)?(?: around| about)?(?: somewhere)?",
    rf"(?:bed|tea|dinner|lunch|nap|home|bath|charging|sleepy|play|work|break) ?time(?: now)?{_ADDRESS}",
    rf"(?:it is|it's) (?:late|early|bed ?time|home ?time|time for bed|nearly (?:bed|dinner|tea|lunch) ?time){_ADDRESS}",
)
_VETO = (
    rf"(?![^,.!;?]*(?:{MARK}|\d|\b(?:go|going|come|coming|drive|driving|find|look|stop|halt|wait|turn"
    r"|follow|bring|say|says|said|tell|tells|told|ask|asks|asked|shout\w*|yell\w*|call(?:ed|s|ing)?|check"
    r"|mean|meant|mind|wrong|joke|joking|kidding|pretend\w*|imagine|dream\w*|thinks?|thought|wish|story"
    r"|movie|film|song|rather|instead|never|done|finished|enough|later|tomorrow|tonight|minutes?|hours?"
    r"|seconds?|before|after|when|while|until|till|if|unless|only|except|but|or|without|o'clock|safe"
    r"|danger\w*|broken|blocked|locked|closed|shut|wet|slippery|glass|fire|burning|smoke|careful"
    r"|what|where|who|whose|which|how|why|somewhere|there|one|two|three|four|five|six|seven|eight|nine|ten)\b))"
)
_DENIES = r"(?![^,.!;?]*(?:\b(?:not|no|nobody|nothing|none|cannot|nor|neither)\b|n't\b))"
_I = r"(?:i|we)(?:'m|'ve|'ll|'d)?"
_SUBJECT = (
    rf"(?:{_I}|(?:he|she|it|they)(?:'s|'re|'ve|'ll)?|(?:the|my|our|your) [a-z]+(?: [a-z]+)?(?:'s)?"
    r"|somebody|someone|everybody|everyone|mum|dad|mom|grandma|grandpa|nana)"
)
_VERB = (
    r"(?:is|are|am|was|were|has|have|had|will|must|got|feel|feels|felt|hurts?|need|needs|hear|heard|smell"
    r"|left|lost|rang|just|only just|ran|fell|spilled|forgot|hate|love|like|live|work|ache|aches|slept"
    r"|woke|sleeps?|rings?|made|cooked|bought|broke)"
)
_WEAK = (
    r"(?:can ?not|can't|could not|couldn't|am not able to|are not able to|will not|won't|have not|haven't"
    r"|am not|are not|'m not|'re not|do not|don't|did not|didn't)"
    r" (?:quite |really |even |ever )?(?:get up|stand(?: up)?|walk(?: (?:far|well|much))?|see(?: (?:well|much"
    r"|a thing|that far))?|hear(?: (?:well|much|a thing))?|reach(?: (?:it|that|that far))?|move(?: much)?"
    r"|get (?:past|by|through|round|around)(?: you| there)?|leave|bend(?: down)?|sleep|manage|manage it|face it|be bothered|feel (?:well|good|great|my [a-z]+)"
    r"|find (?:my|the|our) [a-z]+(?: [a-z]+)?|remember(?: (?:where|what)(?: [a-z]+){1,5})?|know where (?:[a-z]+ ){1,4}"
    r"(?:is|are)|cope|well|feeling (?:well|great|too good)|up to it|too (?:steady|well|good|sure)|sure|free"
    r"|so young|as young as i was)"
)
_STATE = rf"{_VETO}{_DENIES}{_SUBJECT}(?:(?: {_VERB})\b[^,.!;?]*|(?<='s|'m) [^,.!;?]+|(?<='re|'ve|'ll) [^,.!;?]+)"
_NO_WISH = (
    rf"(?![^,.!;?]*(?:{MARK}|\b(?:you (?!something|to)|if|unless|until|till|when|while|before|after|but|or|only"
    r"|except|instead|rather|stop|wait|go|come|find|first|later|tomorrow)\b))"
)
_WANTS = (
    rf"{_NO_WISH}{_DENIES}(?:i|we)(?: just| only| really)?(?: want| need| have| would like|'d like| am going| are going| am trying"
    r"| are trying|'re trying| am about)(?: got)? to (?:show|film|record|photograph|have|take|eat|get|make|sleep|work|read"
    r"|rest|relax|pay|cook|surprise|play|practi[sc]e|shower|wash|hoover|pack|dress|study|concentrate)\b[^,.!;?]*"
)
_COMES = (
    r"(?:(?:i|we|he|she|they|(?:the|my|our) [a-z]+(?: [a-z]+)?|mum|mom|dad|granny|grandma|grandpa|nana|nan"
    r"|company|guests|visitors|people|somebody|someone)(?: is| are| am|'s|'re|'m))(?: (?:already|just|all|also))?"
    r" (?:coming|on (?:my|his|her|our|their|the) way|going (?:out|to (?:bed|work|sleep)))"
    r"(?: (?:over|round|home|soon|too|now|today|tonight|for (?:dinner|tea|lunch|supper|a visit)))*"
)
_SOON = r"(?: (?:soon|later|then|in (?:a|one|two|five|ten) (?:secs?|seconds?|mins?|minutes?|moment|bit)))?"
_JOINS = (
    r"i(?:'ll| will) (?:join (?:you|them)|be (?:right )?(?:there|along|with you|behind you)|follow(?: you)?"
    rf"|catch (?:you )?up|(?:see|meet) you there|come(?: too| along)?){_SOON}"
    r"|we(?:'re| are) (?:having|expecting|getting) (?:some )?(?:guests|visitors|people|company|friends|family)"
    r"(?: (?:over|round|tonight|today|later|soon|tomorrow|for (?:dinner|tea|lunch|supper)))*"
    r"|you know (?:the (?:drill|way|routine)|what to do)"
)
_HAD = (
    r"(?:i|we|he|she|they|it)(?: only| just| definitely)? (?:had|saw|was|used) (?:it|them|here|there)"
    r"(?: only| just)? (?:(?:a|one|two|five|ten|a few) (?:secs?|seconds?|mins?|minutes?|moments?|hours?|days?) ago"
    r"|earlier|yesterday|last night|this (?:morning|afternoon))"
)
_CANNOT = rf"(?![^,.!;?]*{MARK}){_I} {_WEAK}(?: (?:right now|today|just now|at the moment|these days|any more))?"
_YOU_ARE_FREE = (
    r"you(?: are|'re) (?:already |so |just )?(?:free|here|up|awake|idle|around|bored|passing"
    r"|not (?:busy|doing (?:anything|much)))"
)
_JOIN = r"(?:(?:so|and|but|because|cause|cos|since|as|seeing as|seeing that|now that|anyway) )"

ENGLISH_ASIDES = AsideForms(
    opening=re.compile(
        r"^(?:(?:(?:can|could|would|will) you(?: like| maybe| possibly)+ (?=[a-z]))"
        r"|(?:would it (?:kill|hurt|be (?:ok|possible) for) you to|how about (?:you|if you)(?: just)?"
        r"|why (?:not|do not you|don't you)|i (?:want|need|would like) you to maybe"
        r"|(?:i(?:'d| would) be |it(?:'d| would) be )(?:ever so |so |very |most |really )*(?:grateful|glad"
        r"|happy|obliged|great|lovely|kind|nice|grand) if you(?: could| would|'d| can| were to)?"
        r"|(?:do you (?:happen to )?know|any idea|do you remember)(?= (?:where|how many|what|who)\b)"
        r"|go on(?=,)|(?:pretty )?please(?: please)*|oh,? and(?: could you also| also)?|and(?: could you)? also|while you are at it)[ ,]+)+"
    ),
    closing=re.compile(
        rf"(?<=[\w\ue000-\ue7ff]),? (?:because|cause|cos|since|as|seeing as|now that)"
        rf" (?:{_STATE}|{_CANNOT}|{_YOU_ARE_FREE})$"
    ),
    joint=re.compile(r"^(?:but|and|so|anyway|well)[ ,]+"),
    seam=re.compile(
        rf"(?P<aside>(?:{FAVOUR}|{BE}|{_SORRY}|i (?:need|have) (?:a|one) favou?r|oh)"
        rf"|{_CANNOT}|{_VETO}{_DENIES}{_SUBJECT} (?:hurts?|aches?|is (?:asleep|sleeping|busy|tired))"
        r"|(?:my|the) [a-z]+ hurts?),? (?:and|but|so)[ ,]+(?=[a-z\ue000-\ue7ff])"
    ),
    praise=re.compile(_PRAISE),
    formula=re.compile("|".join(f"(?:{each})" for each in _FORMULAS)),
    speaks=re.compile(r"\b(?:tell|say|ask|announce|shout|remind|inform|let|repeat|call|warn)\b"),
    states=(
        re.compile(rf"{_JOIN}?{_STATE}"),
        re.compile(rf"{_JOIN}?{_CANNOT}"),
        re.compile(rf"{_JOIN}?{_YOU_ARE_FREE}"),
        re.compile(rf"{_JOIN}?(?:{_WANTS}|{_COMES}|{_JOINS}|{_HAD})"),
    ),
)
