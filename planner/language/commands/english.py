"""Own the English sentences that are said to the planner itself. Whole sentences, never a part.

Each pattern is matched against words in lower case with single spaces; punctuation between polite
words is gone, the name of a place is taken as it was written.
"""

from __future__ import annotations

import re

_POLITE = (
    r"please|pls|plz|kindly|just|now|then|so|well|ok|okay|alright|all right|yes|yeah|oh|hey|hi"
    r"|robot|pons|thanks|thank you|good|great"
)
COURTEOUS = re.compile(
    r"(?:(?:hey|hi|ok|okay|robot|pons|please),? )*(?:can|could|would|will) you\b"
)
"""A question mark behind these is courtesy; behind anything else it asks."""
ASKING = re.compile(r"(?!)")
"""A word at the end that asks: there is none in English."""
_RIGHT = (
    r"(?:right|fine|sure|perfect|lovely|brilliant|thanks)"
    r"(?=,| (?:then|carry|go|keep|continue|resume|you|hold on|hang on)\b)"
    r"|(?:okay|ok|all right|alright) then"
)
POLITE = re.compile(
    rf"(?:{_POLITE}|{_RIGHT}|(?:can|could|would|will) you"
    r"|that's (?:that|it|me|better|done)(?=,))(?![\w'])"
)
THANKS = re.compile(
    rf"(?:^| )(?:{_POLITE}|for me|right now|again|would you|will you|could you|mate|buddy|pal|love"
    r"|dear|darling|my friend|if you (?:please|would|don't mind|do not mind)"
    r"|in case (?:i|we|you|someone|somebody|anybody) (?:asks?|needs?|wants?|forgets?)[a-z' ]*)$"
)

_TASK = (
    r"(?:goal|mission|task|job|order|trip|drive|driving|plan|route|way|request|errand|command"
    r"|search|hunt|count|patrol|tour)"
)
_THE_TASK = rf"(?:(?:the|this|that|my|your|our) )?(?:(?:current|running|last|latest) )?{_TASK}"
_BRIEF = r"(?:(?:a|one|just a) )?(?:moment|sec|bit)"

_WORK = r"(?:go|look|search|hunt|seek|find|count|track|follow|patrol|check)"
_IT = (
    r"(?: (?:for|at|in|to|after|with))?"
    r"(?: (?:it|that|this|there|them|him|her|me|us)| (?:the|an?|any|my|your|this|that) [a-z]+)?"
)
"""What was looked for, in so few words that no second order hides in them."""
_MORE = r"(?:any ?more|any longer|after all)"

RESUME = re.compile(
    r"(?:continue|resume|proceed|carry on|go on|keep going|unpause)"
    r"|(?:continue|resume|proceed with|carry on with|go on with|unpause)"
    rf" (?:it|that|this|{_THE_TASK})"
    r"|(?:continue|carry on|go on|resume|keep) (?:driving|going|moving)"
    r"|(?:continue|carry on|go on|get on|go back to|back to)(?: with)? what you were doing"
    r"|as you were|pick up where you left off|(?:off|away|on) you go(?: again| now)?"
    r"|you can get going again|back to it"
    r"|keep (?:looking|searching|patrolling|counting|following|at it)|get (?:going|moving) again"
    r"|you (?:can|may) (?:continue|resume|proceed|carry on|go on|keep going|go)(?: again| now)?"
    r"(?:[ ,]+(?:continue|resume|carry on|go on|keep going))?"
)
PAUSE = re.compile(
    rf"pause (?:for(?: now)?|here|for {_BRIEF}|{_BRIEF}|this|{_THE_TASK}|what you are doing)"
    r"|(?:hold on|hang on)(?: (?:a|one) (?:moment|second|sec|minute))?"
    r"|hold it (?:a|one) (?:moment|second|sec|minute)"
    r"|(?:a|one|just a) (?:moment|sec)"
    r"|just a (?:second|minute)|give me a (?:moment|second|sec|minute)|take a break"
    r"|wait (?:just )?a (?:second|sec|moment|bit)"
)
CANCEL = re.compile(
    rf"(?:cancel|abort|drop|call off) (?:it|this|that one|{_THE_TASK})|call it off"
    r"|(?:forget (?:it|that)|scrap that|leave it)[ ,]+(?:never ?mind|i changed my mind)"
    r"|(?:never ?mind|forget it)[ ,]+(?:forget it|leave it|leave that)"
    r"|(?:ok |okay |no[ ,]+)?(?:that(?:'s| is) )?(?:far |quite |good )?enough"
    r"(?: (?:for )?(?:now|today|tonight|this (?:morning|afternoon|evening)))?"
    r"(?:[ ,]+(?:quit it|stop it|thank you))?"
    r"|forget (?:it|that|this|about (?:it|that|this)|what i (?:said|told you))"
    rf"|forget (?:about )?{_THE_TASK}"
    r"|never ?mind(?: (?:it|that|about (?:it|that)))?"
    r"|scratch that|scrap (?:that|the|this)(?: whole)?(?: thing| lot)?"
    r"|(?:don't|do not) (?:bother|trouble)(?: yourself)?"
    r"|leave it(?: be| then)?|forget it then"
    r"|no need(?: (?:any ?more|for (?:it|that)))?|i changed my mind"
    rf"|(?:don't|do not) go(?: there)?(?: {_MORE})?"
    rf"|(?:don't|do not) go (?:in)?to (?:the |my |our )?[a-z]+(?: [a-z]+)? {_MORE}"
    r"|(?:(?:there(?:'s| is) )?no need|(?:you )?(?:(?:don't|do not) (?:need|have)|need not"
    rf"|needn't))(?: to)? {_WORK}{_IT}(?: {_MORE})?"
)
TAKEN_BACK = re.compile(
    rf"{CANCEL.pattern}|change of plans?|new plan"
    r"|(?:(?:no|nope|wait|hey)[ ,.!]+)*(?:that(?:'s| is| was) )?(?:the )?wrong (?:way|direction"
    r"|side)"
)
"""What may stand before the order that comes in place of the current one."""
ORDERS = re.compile(
    r"(?:not|don't|do not|never (?!mind))\b"
    r"|.*\b(?:go|come|drive|head|find|look|search|count|follow|patrol|wait|bring|take|turn|say"
    r"|tell|ask"
    r"|remind|remember|if|when|unless|until)\b"
)
"""With these a clause is no mere reason."""
_SOMEBODY = (
    r"(?:i|we|he|she|it|they|somebody|someone|that)(?='|\b)|(?:the|my|our|his|her) [a-z]+"
    r"|mum|mom|dad|daddy|mummy|mommy|grandma|grandpa|granny|nan|gran"
)
REASON = re.compile(
    r"(?:i|we)(?:'ve| have| already)* (?:got|found|have|see|saw|(?:can )?hear|heard|know|did"
    r"|done|remember(?:ed)?|was wrong|changed my mind|can do|will do)\b(?! (?:to|you)\b)[a-z' ]*"
    r"|you (?:do not|don't) (?:have|need) to(?: [a-z ]{1,20})?|no need(?: to [a-z ]{1,20})?"
    r"|(?:it|that|they|she|he)(?:'s| is| are|'re| was| were) (?:already |right |all |not )*"
    r"(?:fine|ok|okay|here|right|found|done|sorted|important|needed|gone|too late)\b[a-z' ]*"
    rf"|(?:{_SOMEBODY})(?:'s|'re|'m| is| are| am| was| were)(?: just| already| still| now)*"
    r" (?:on (?:his|her|their|my|our|the|its) way|coming|back|home|up|down|in|out|asleep|sleeping"
    r"|awake|busy|eating|leaving)\b(?!.*\b(?:you|but|and|or|so|then|if)\b)[a-z' ]*"
    rf"|(?:{_SOMEBODY})(?:'s|'ve| has| have)?(?: just| already| finally)* (?:came|come|been|gone"
    rf"|went"
    rf"|left"
    r"|arrived|turned up|showed up|woke|woken|got|called|rang|rung|phoned|texted|answered|did|done"
    r"|finished|found|brought|fetched|taken|took|told|said|are|is|was|am)\b"
    r"(?!.*\b(?:you|but|and|or|so|then|if)\b)[a-z' ]*"
)
"""Why something is taken back, said behind it: it orders nothing."""
POSTPONED = re.compile(
    r"(?:(?:no|wait|oh)[ ,]+)*(?:not (?:just )?yet|not (?:right )?now|not straight away"
    r"|in a minute)"
    r"(?: actually| though)?|(?:actually|oh)[ ,]+not (?:yet|now)"
)
"""Puts off what runs, where an order follows that comes first: "not yet, come with me"."""
PAUSE_REASON = re.compile(
    rf"(?:there|someone|(?:the|my|our) (?:[a-z]+ )?[a-z]+|{_SOMEBODY})"
    r"(?:'s|'re|'m|'ve|'ll be| is| are| am| has| have| need| needs| got| was)\b"
    r"(?!.*\b(?:you|if|or|then|so|go|come|turn|kitchen instead)\b)[a-z' ]*"
)
"""Why the robot is to wait a moment: it orders nothing, and corrects nothing."""
COMES_FIRST = re.compile(
    r"(?:first[ ,]+|please[ ,]+|you (?:need|have) to )*(?:go|come|drive|head|find|look|search|count"
    r"|follow|turn|say|tell|ask|take|check|move|back up)\b(?!.*\b(?:if|unless|when|until|or)\b)"
)
DENIES = re.compile(r"(?:don't|do not) (?:go|bother)\b.*|drop (?:it|this|that one)")
"""Of these, what means the whole sentence where it goes on with "and": "don't go and turn left"."""
GOES_ON = re.compile(r"(?:and|or|then)\b")
UNPUNCTUATED = re.compile(
    r"(?:forget (?:that|it)|never ?mind(?: that)?|scratch that)(?: and)?"
    r" (?=(?:go|come|drive|move|return|head|wait|turn|patrol) )"
)
_ONE_ORDER = r"(?:(?!\b(?:if|or|unless|when|until|otherwise|then)\b|[;:.?])[^;])+?"
"""Without a condition or a second order: "go to the kitchen; if you can't get in, wait in the hall
instead" replaces nothing."""
INSTEAD = re.compile(
    rf"instead,? (?P<rest>(?:go|come|drive|move|return|head|wait|turn|patrol)\b{_ONE_ORDER})"
    rf"|(?P<rest2>(?:go|come|drive|move|return|head|wait|turn|patrol)\b{_ONE_ORDER}),? instead"
)
_SPEED = r"(?: (?:a (?:little|bit|lot)|a little bit|much|even|still|down|up|more))*"
_SOME = r"(?:you (?:can|may) )?(?:(?:(?:a )?(?:little|bit|lot|little bit)|much|even|still|some) )?"
SLOWER = re.compile(
    rf"{_SOME}(?:(?:slow down|ease off|ease up|easy does it)(?: a (?:little|bit)| there| now)*"
    rf"|(?:(?:go|drive|move|roll)(?: a (?:little|bit)| much)? )?(?:slower|more slowly){_SPEED})"
    r"|(?:go|drive|move|roll)(?: along| on)? (?:slowly|gently|carefully)"
    r"|(?:not|do(?: not|n't) (?:go|drive|move)) (?:so|that|too) fast|reduce (?:your |the )?speed"
    r"|(?:that is |that's |you are |you're |it is )?(?:way |much |going |driving )?too fast"
)
FASTER = re.compile(
    rf"{_SOME}(?:(?:speed up|hurry up|faster|quicker){_SPEED}|(?:go|drive|move)"
    rf"(?: a (?:little|bit))? (?:faster|quicker){_SPEED})"
    r"|(?:normal|full|usual) speed(?: again)?|(?:not|do(?: not|n't) (?:go|drive|move)) (?:so|that"
    r"|too) slow(?:ly)?|too slow"
)
WHERE = re.compile(
    r"where are you(?: (?:now|at|right now|currently|at the moment))*|tell me where you are"
    r"|(?:what is|what's|report|tell me) your (?:current )?(?:location|position)"
    r"|(?:which|what) (?:room|place) are you (?:in|at)(?: now)?"
)
DOING = re.compile(
    r"what are you (?:doing|up to)(?: (?:now|right now|at the moment|there))?"
    r"|where are you (?:going|driving|heading)(?: (?:to|now))?"
    r"|(?:what is|what's) (?:your|the) (?:current )?(?:status|goal|task)"
    r"|status(?: report)?|report(?: your)? status|tell me what you are doing"
    r"|(?:are you|have you) (?:done|finished|ready|there)(?: yet| now| already)?"
    r"|are you (?:stuck|lost|blocked|okay|ok|alright|all right)(?: or (?:something|what))?"
    r"|why (?:did|have) you (?:just |suddenly |even )?(?:stop|stopped|pause|paused|halt|halted)"
    r"|why are you (?:not moving"
    r"|standing(?: still| there)?|waiting|stopped)|how is it going|how far (?:along )?are you"
    r"|what(?:'s| is) next"
    r"|where (?:are you )?(?:going|off to) (?:next|after (?:this|that)(?: one)?)"
    r"|why(?: there)?|why are you going there"
    r"|what(?:'s| is) (?:keeping|taking) you(?: so long)?|what are you on(?: with)?"
    r"|why (?:aren't|are not) you (?:moving|doing anything|going|driving)|why (?:don't"
    r"|do not) you move"
    r"|what(?:'s| is) (?:the hold-? ?up|taking so long|the matter(?: with you)?"
    r"|wrong(?: with you)?)|what are you playing at"
    r"|how (?:much|many) longer(?: (?:will|is|are|do) (?:it|that|this"
    r"|you)(?: going to)?(?: (?:take|be|need))?)?"
    r"|how long (?:will|is|are) (?:you|it|that|this)(?: going to)? (?:be|take)|are you (?:nearly"
    r"|almost) (?:done|there|finished)"
)
_CHARGE = r"(?:battery|charge|power|juice)"
_YOUR = r"(?:your|the) (?:current )?"
BATTERY = re.compile(
    rf"how(?:'s| is| are)? {_YOUR}{_CHARGE}(?: (?:doing|level|now))?"
    rf"|how (?:much|is) {_CHARGE}(?: level)?"
    r"(?: (?:do you have|have you got|is)(?: left| in you)?| left)?"
    rf"|(?:what(?:'s| is)|tell me|report) {_YOUR}(?:battery|charge)"
    r"(?: (?:level|status|state|percentage))?(?: at| on)?(?: right now| now)?"
    rf"|{_YOUR}?battery (?:level|status)"
    rf"|(?:are you|is {_YOUR}battery) (?:fully |already |still )?(?:charged|full|empty|low|flat"
    rf"|running (?:low|out)|(?:running )?(?:low|out) (?:on|of) {_CHARGE})(?: yet| enough| already)?"
    rf"|(?:do you have|have you got|you(?:'ve)? got|you have) enough {_CHARGE}(?: left)?"
    r"(?: for [a-z ]{1,30})?|do you need (?:to be )?(?:charging|charged|a charge|to charge)"
)
_THEM = r"(?:it|him|her|them|that|one|any)"
_THEN = r"(?: (?:yet|then|now|there|in there|at all|in the end|in all|altogether|in total))*"
OUTCOME = re.compile(
    rf"did you (?:find|get|spot|catch|manage|see|reach|make|ask|tell) {_THEM}{_THEN}"
    rf"|(?:have you )?(?:found|got|seen) (?:{_THEM}|anything)(?: yet)|any luck(?: (?:yet|with it))?"
    rf"|(?:and )?how many(?: (?:was (?:it|that)|is it|(?:were|are) (?:there|they|those|in there)"
    rf"|did you (?:find|see|count|get)))?{_THEN}"
    r"|(?:and )?what did (?:he|she|they) (?:say|answer|reply|want)"
    r"|(?:and )?(?:tell (?:me|us) )?what (?:he|she|they) (?:said|answered|replied|told you)"
    r"|what(?:'s| is| was) (?:his|her|their|the) (?:answer|reply|result|outcome|verdict)"
    r"|did (?:he|she|they) (?:answer|reply|say (?:yes|no|anything|something)|hear (?:you|it|that))"
    r"|did you manage(?: (?:it|that|to (?:find|get|see|spot|do|count|reach) [a-z' ]{2,30}))?"
    rf"|how did (?:it|that) go|did (?:it|that) work(?: out)?|what happened{_THEN}"
    r"|where (?:was|were) (?:it|he|she|they)"
    rf"|(?:was|were) (?:he|she|it|they|any|one) (?:in |over )?there{_THEN}|did you get there"
)
"""Asks how the goal before ended; where there was none, a brain reads it."""

_HERE = r"(?:this|here|(?:this|that|the current) (?:place|spot|location|position|point)(?: here)?)"
_SPOT = r"(?:this|the current) (?:place|spot|location|position|point|corner)|here"
REMEMBER = re.compile(
    rf"(?:remember|save|store|memori[sz]e|learn|mark|record) {_HERE} as (?P<a>.+)"
    rf"|(?:let's |let us )?(?:call|name|label) (?:{_SPOT}) (?P<b>.+)"
    rf"|(?:remember (?:that )?)?(?:{_SPOT}) is (?:called|named) (?P<c>.+)"
)
KEEP_SKILL = re.compile(
    r"(?:remember|save|store|keep|learn|record) (?:that|what you (?:just )?did"
    r"|(?:this|that|the last) (?:order|job|task|routine)) as (?P<a>.+)"
)
FORGET = re.compile(
    r"(?:forget|delete|remove)(?: about)? (?:the |my )?(?:place|spot|location)"
    r"(?: (?:called|named))? (?P<a>.+)"
    r"|(?:forget|delete|remove) the (?:taught|learnt|remembered) place (?P<b>.+)"
    r"|forget where (?P<c>.+) (?:is|was)"
)
HERE = re.compile(
    r"you(?:'re| are)(?: now| right now)? (?:in|at|near|next to|beside|by) (?P<a>.+?)"
    r"(?: now| right now)?"
)

_THIS_IS = (
    r"this is (?!(?:called|named|it|that|not|a|an|what|where|how|why|enough|good|great|fine"
    r"|wrong)\b)"
    r"(?:the |my |our )?[a-z' ]{2,40}(?:room|bedroom|office|bed|desk|chair|seat|place|corner"
    r"|spot|table|shelf)"
)
_ORDERS = (
    r"(?:to|me|it|him|her|them|us|this|that|these|here|where|who|what|how|when|why|which|if|whether"
    r"|as|for|about|you|everything|anything|nothing|something|please)\b"
)
_NOUN = r"(?:(?:the|my|our|your|his|her|their|a|an) )?[a-z0-9' ]{2,40}?"
_SAYS = (
    r"(?:is|are|was|were|has|have|had|will|can|can't|cannot|does|doesn't|don't|likes?|loves?"
    r"|hates?|needs?"
    r"|takes?|comes?|lives?|sleeps?|works?|eats?|belongs?|goes|arrives?|leaves?|means?|must"
    r"|should|may|isn't"
    r"|aren't|wants?|keeps?|uses?|opens?|closes?|starts?|ends?)"
)
_KEEP = (
    r"(?:remember|note(?: down)?|keep in mind|bear in mind|memori[sz]e|make a note"
    r"|take a note|write down"
    r"|(?:don't|do not|never) forget)"
)
_DOES = (
    r"(?:please|go|come|drive|find|look|get|tell|ask|say|wait|follow|bring|take|turn|stop|if|when"
    r"|you|i|we|it|there|what|who|where)\b"
)
_OWNED = r"(?:(?:the|my|our|his|her|their|[a-z]+'s) [a-z0-9' ]{2,40}?)"
_PUT = (
    r"(?:i|we|he|she|they)(?:'ve| have|'m| am| are)? (?:just |already )?(?:put(?:ting)?|left|parked"
    r"|parking|placed|stored|hid|keep)"
)
_KEPT = (
    rf"[,;.!]+ (?:and |so |please )*(?:{_KEEP}|keep (?:that|it) in mind|you should know"
    r"|make a note)(?: (?:of )?(?:it|that|this))?(?: please)?"
)
KEPT = re.compile(rf"{_KEPT}$")
"""Asks behind a statement to remember it."""
TEACH = re.compile(
    rf"{_KEEP}(?: that|:| this:| the following:|,)+ (?P<a>(?!to\b).{{4,}})"
    rf"|{_KEEP} (?P<f>(?:i|we|he|she|they)\b(?! (?:want|need) you\b)(?!.*\b(?:if|when|until"
    rf"|unless)\b)[^?]{{4,}})"
    rf"|{_KEEP} (?P<b>(?!{_ORDERS}){_NOUN} {_SAYS}\b.*)|(?P<c>{_THIS_IS})|{_KEEP} (?P<d>{_THIS_IS})"
    rf"|(?P<e>(?:(?!{_DOES}){_NOUN} {_SAYS}|{_PUT})\b[^,;:.!?]{{2,80}}){_KEPT}"
)
"""What is to be remembered, word for word."""
LESSON = re.compile(rf"{_KEEP}(?: that|:| this:| the following:|,)+ ")
"""How a fact begins that may be of any length."""
THIS_IS = re.compile(r"this is .*")
_ABOUT = r"(?P<{}>[^,;:.!?]{{2,60}})"
_DROP = r"(?:forget|delete|erase|remove|drop)"
_I_SAID = r"(?:i|we)(?:'ve| have)? (?:ever )?(?:said|told you|taught you)"
FORGET_TOLD = re.compile(
    rf"{_DROP}(?: about)? (?:what|everything|all|anything)(?: that)? {_I_SAID}(?: (?:to you"
    rf" )?about {_ABOUT.format('a')})?"
)
FORGET_SEEN = re.compile(
    rf"{_DROP}(?: about)? (?:what|everything|all|anything)(?: that)? you(?:'ve| have)? (?:ever"
    rf" )?(?:saw|seen)"
    rf"(?: of {_ABOUT.format('a')})?"
)
FORGET_ALL = re.compile(
    rf"{_DROP} (?:everything|all)(?: that)?(?: you (?:know|remember|have remembered))?"
    rf"|(?:{_DROP}|clear|wipe) (?:all (?:of )?)?your (?:whole |entire )?(?:memory|memories)"
)
FORGET_ABOUT = re.compile(
    rf"{_DROP} (?:everything |all |that |the thing |that thing |what you (?:know|remember)"
    rf" )?(?:about|of) {_ABOUT.format('a')}"
)
_AT = r"(?:in|on|at|under|behind|near|next to|beside|inside|on top of)"
_LIES_AT = rf"{_AT} (?:the|my|our|your|[a-z]+'s) [a-z0-9' ]{{2,40}}"
STATEMENT = re.compile(
    rf"(?:(?:just )?so you know|fyi|for the record|for your information)[ ,:]+(?!{_DOES}){_NOUN}"
    rf" {_SAYS}\b[^,;:.!?]{{2,80}}|(?:by the way)?[ ,:]*(?:"
    r"(?:the|my|our|[a-z]+'s) [a-z0-9' ]{2,40}? (?:is|are) (?:still |now |always |usually "
    rf"|lying |kept |stored )?{_LIES_AT}"
    rf"|{_OWNED} (?:lives?|belongs?|goes) (?:{_LIES_AT}|to [a-z' ]{{2,30}})"
    rf"|{_PUT} (?:the|my|our|your|a|his|her) [a-z0-9' ]{{2,40}}? {_LIES_AT}"
    r"|my name(?: is|'s) [a-z' -]{2,30}|my favou?rite [a-z ]{2,30} (?:is|are) [a-z' ]{2,40}"
    r"|this is (?:my|our) (?!(?:way|turn|fault|last|chance|problem|place)\b)[a-z]+ [a-z' -]{2,30}"
    r")(?:,? by the way)?"
)
"""A flat statement that says where something is, whose it is or who somebody is; said as an order
of its own it is worth remembering."""

DETERMINER = re.compile(r"(?:the|my|our) ")
NO_NAME = re.compile(
    r"(?:an?|you|i|we|it|he|she|they|if|when|while|as|soon|well|long|what|who|where|how|which|why"
    r"|in|at|on|for|by|being|is|are|was|something|anything|nothing|that|this|there)\b.*"
    r"|.*\b(?:and|or|then|to|from|if|when|until|before|after|because|not|is|are|please)\b.*"
    r"|.*[,;:.!?].*"
    r"|(?:off|out of)[ -](?:limits|bounds).*|no[ -]go\b.*|forbidden.*|prohibited.*"
    r"|danger(?:ous)?(?: (?:zone|area|spot|place|for .*))?"
)
"""What a sentence goes on with where no name stands: "remember this as you drive". And what says to
keep out: a taught place is one to drive to."""
