"""Hold the closed words by which a clause is judged: one table a language, read by `clauses`.

Data alone. Verbs are an open class, so a row never lists what people might call a drive beyond the
plain ones; what is listed whole are the words that make a clause no order: denial, tense, somebody
else, supposition, speech.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Self

from planner.language.person_names import NAMES_ZH

Pattern = re.Pattern[str]


@dataclass(frozen=True, slots=True)
class ClauseWords:
    """Hold the rows of one language; every row but ``splits`` is matched where a clause opens."""

    splits: Pattern
    """Where one clause ends and the next begins."""
    opens: Pattern
    """Courtesy, hesitation and names for the robot: set aside before a clause is judged."""
    to_you: Pattern
    """What makes a wish of the person an order of the robot: "could you", 我要你."""
    orders: Pattern
    """Plain verbs of an order."""
    ways: Pattern
    """Opens an order without a verb: "to the study", "left"."""
    stays: Pattern
    """Orders that lead nowhere: no place beside them is gone to."""
    denies: Pattern
    excepts: Pattern
    """Denials that leave out one thing and end before the next order."""
    no_denial: Pattern
    """Words that look like a denial and are none; blotted out before one is sought."""
    hangs: Pattern
    """Opens a condition."""
    awaits: Pattern
    """An order to wait for something: what follows hangs on it."""
    polite: Pattern
    """Looks like a condition and is none."""
    otherwise: Pattern
    later: Pattern
    """A time that is not now, anywhere in a clause."""
    past: Pattern
    others: Pattern
    """Somebody who is not the robot, before the verb."""
    supposes: Pattern
    """What is only imagined, asked of ability, or proposed; anywhere in a clause."""
    asks: Pattern
    corrects: Pattern
    """Takes back what stands before it, where a place follows."""
    speaks: Pattern
    """What follows is said to somebody, anywhere in a clause."""
    beyond: Pattern
    """What no robot here does, an arm's work, harm and haste: the whole order is asked about."""
    chooses: Pattern
    """Between two places: either, and nobody said which."""

    @classmethod
    def of(cls, **rows: str) -> Self:
        """Compile the rows."""
        return cls(**{name: re.compile(row) for name, row in rows.items()})


_ACTOR = (
    r"(?:i|we|he|she|it|they|there|this|that|who|some(?:one|body)|every(?:one|body)|any(?:one|body)"
    r"|no(?:body| one)|people|kids?|children|guys|folks|everyone|mr|mrs|ms|miss|dr|mom|mum|mommy"
    r"|mummy|mother|dad|daddy|father|grand\w+|gran|granny|nana|auntie|aunt|uncle|papa|mama|wife"
    r"|husband|son|daughter|brother|sister|boys|girls|honey|darling|doctor|nurse|guests?)"
)
_GO = (
    r"go|goe?ing|drive|driving|ride|come|coming|walk|run|rush|hurry|dash|head|move|roll|scoot"
    r"|travel|navigate|proceed|get|visit|visiting|swing|stop|return|lead|guide|escort|accompany"
    r"|follow|meet|greet|welcome|patrol|rounds?|tour|inspect|check|look|looking|see|find|search"
    r"|count|scan|watch|monitor|explore|observe|survey|approach|reach|position|charge|recharge"
    r"|dock|enter|leave|pop|nip|peek|peep|pass|cross|join|locate|turn|spin|rotate|face|back"
    r"|reverse|step|circle|creep|crawl|track|trail|chase|take|bring|conduct|continue|park|stand"
    r"|spot|ask|call|wake"
    r"|tell|say|wait|stay|shoo|map|report|describe|identify|let|read|have a (?:look|rest|peek)"
    r"|(?:do|make|take) (?:a|an|the|your|one|another|yourself|me|us|it|that|this)|show"
    r"|introduce|keep|try|find out|listen|answer|hide|rest|sleep|lie|sit|settle"
    r"|hang (?:around|out)|make sure|drop (?:by|in)|inform|contact|seeing|checking|making|finding"
    r"|telling|asking|following|turning|moving|having|taking a"
)
ENGLISH = ClauseWords.of(
    splits=r"(?:[;!?:|…]|\.(?!\d))+|,|\b(?:and then|and|then"
    r"|(?<!where )(?<!rooms )(?<!room )(?<!thing )but(?! not)|because|while|since)\b"
    r"|(?=\b(?:otherwise|or else|else|if|unless|when(?:ever)?|once|as soon as|in case)\b)",
    opens=r"(?:please|pls|ok(?:ay)?|well|so|now|hey|hi|hello|robot|pons|just|no|not|yes|yeah|right"
    r"|um+|uh+|er+|hm+|oh|ah|quick|quickly|slowly|quietly|gently|carefully|first|next|finally|also"
    r"|again|actually|sorry|instead|kindly|wait(?= (?:no|go|the|i)\b|$)|still"
    r"|(?:hold|hang) on|come on|go on(?! (?:to|into)\b)"
    r"|after that|in a moment|off"
    r"|good (?:boy|girl|robot|morning|night|evening|afternoon)|little one|buddy|pal|mate|sweetie"
    r"|always|only|last|of all|as you can|that's right|nope|thanks?(?: you)?|fast|faster|careful"
    r"|be (?:a|an|so) \w+(?: and| to)?|dear|there|here|anyway|all ?right|then|or|rather|on|love"
    r"|listen|great|fine|sure|(?:after|when|once) you(?:'re| are|'ve| have)? (?:done|ready|been)"
    r"|(?:before|after)(?: you)?(?= \w+)|if you please)\b[ ']*",
    to_you=r"(?:(?:can|could|would|will|won't|may|should|must) you"
    r"|why (?:don't|not|do not)(?: you)?|(?:would|do) you mind|mind"
    r"|you(?:'d| had)? (?:can|could|may|must|should|need to|have to|ought to|better|will)"
    r"|(?:i|we)(?:'d| would| will)? ?(?:want|need|like|love|wish|expect|ask)s? you"
    r"|would it be possible for you to|you(?:'re| are) (?:to|needed|wanted)|let's|let us|let me see"
    r"|i(?:'d| would) (?:appreciate|be \w+)(?: it)? if you|you|time (?:for you )?to|it's time"
    r"|feel free to|try|start|begin|finish|keep|i (?:said|mean|meant)|what about|how about)\b[ ']*"
    r"(?:(?:could|would|can|please|to|by|with|like|kindly|just|also|now|then|first|quickly|and"
    r"|be so kind as|be able|mind|awfully|terribly|ever so kindly)\b ?)*",
    orders=rf"(?:{_GO})\b",
    ways=r"(?:to|into|towards?|over|out|through|up|down|away|forwards?|straight|left|right|via|back"
    r"|for the|home(?=\W*(?:now|please)?\W*$)|\d+|(?:a |another )?(?:trip|tour|round|lap|look)s?"
    r"|every|each|all|everywhere"
    r"|towards)\b",
    stays=r"(?:tell (?:me|us)|let me know|show me|wait|stay|stand still|keep still|remind"
    r"|remember|sing|hang on|hold)\b",
    denies=r"\b(?:do not|don't|dont|never|must not|mustn't|may not|should not|shouldn't|cannot"
    r"|can't|no need to|no reason to|need not|needn't|avoid|refrain|forget|under no circumstances"
    r"|no longer|not|nor|neither|off limits|(?:stays?|keep|get) (?:out|away)(?! of the way))\b",
    excepts=r"\b(?:except|excepting|excluding|without|skip|skipping|instead of|rather than"
    r"|apart from|other than|besides|omit|leave out|leaving out|but not|not"
    r"|(?<=anywhere )but|(?<=everywhere )but|(?<=rooms )but|(?<=room )but|(?<=everything )but)\b",
    no_denial=r"not only|not (?:too|so|very|that) \w+|(?:don't|do not) (?:forget to|mind|worry"
    r"|hesitate)|not (?:sure|far)|forget (?:that|it)|why (?:don't|not)(?: you)?"
    r"|\b(?:is|was|are|were|if|or|could|did|does|has|have|had|would|you|i|we|he|she|it|they|it's"
    r"|he's|she's|that's|they're|there's) (?:not|don't|do not|can't|cannot|never)\b",
    hangs=r"(?:(?:only )?(?:if|unless|when(?:ever)?|once|as soon as|in case|provided))\b",
    awaits=r".*\b(?:until|till)\b",
    polite=r"if (?:possible|you please|you (?:would|could|can|like|want|don't mind"
    r"|do not mind))\b(?!')"
    r"|(?:when|once|as soon as) (?:you(?:'re| are)? (?:done|ready|get|arrive|reach|have|there"
    r"|come|back|been)"
    r"|done|finished|there)\b",
    otherwise=rf"(?:otherwise|or else|else|failing that)\b|if no\W*$|if not(?:\W*$| (?="
    rf"(?:{_GO})\b))",
    later=r"\b(?:tomorrow|tonight|later|next time|at (?:\d|noon|midnight)|in \d+ (?:minute|hour)s?"
    r"|every (?:day|morning|evening|night))\b",
    past=r"(?:did|was|were|had|have you|has|haven't|thanks? (?:you )?for|you(?:'ve|'re|'d| have"
    r"| had| did| just| already| always| never| were| was| are)? ?(?!are needed|are wanted|need)"
    r"(?:went|drove|came|found|saw|looked|checked|were|was|did|been|have|had|know|keep|always"
    r"|never|meant|used|did|so|such|\w+ed|really|look (?:so|good|great|nice)|brilliant|good|bad)"
    r"|what would|how do i|how can i)\b|.*\b(?:yesterday|last (?:night|week|time)|this morning"
    r"|earlier|ago)\b",
    others=rf"(?:(?:my|our|your|the|a|an|his|her|their|too many|most|some|both|no|one) )*{_ACTOR}"
    r"\b(?!\W*$)|(?:my|our|his|her|their|your|the|a|an|these|those|its) (?!room\b)",
    supposes=r"\b(?:imagine|suppose|pretend|your favou?rite|you like best|would you (?:rather|be"
    r"|ever|like it|prefer|go if)"
    r"|what would|if i were|if i fell|i wish|maybe|perhaps|shall (?:we|i)|should (?:we|i)"
    r"|could we|are you able|by yourself|do you know how|might|what if)\b",
    asks=r"(?:what|who|whose|which|where|how|is|are|isn't|aren't|do|does|has|have|any|anyone"
    r"|anybody|why)\b|.*\?\s*$",
    corrects=r"(?:no|nope|oh no|sorry|scratch that|wait no|no wait|i mean|i meant|actually)\b",
    speaks=r"\b(?:say|saying|tell|announce|inform|shout|whisper|repeat|remind|ask|read|answer"
    r"|reply|call out|sing|know)\b",
    beyond=r"(?:(?:then|also|to) )*(?:(?:bring|take|fetch|get|carry|deliver|give|hand|move|put"
    r"|place) (?:it|this|that)\b"
    r"|(?:pick|put|place|grasp|grab|fetch|carry|deliver|open|close|clean|wash|pour|wipe|tidy|cook"
    r"|serve|press|hand|give"
    r"|leave it|knock(?! knock| on| at|\W*$)|push|pull|kick|throw|drop (?!by|in)|smash|spill"
    r"|shake|crash|ram|hit|bump|hurt|break)\b(?! me the (?:time|name))"
    r"|(?:bring|take|get) (?:me |us )?(?:the|a|an|my|some) (?!(?:\w+ ){0,2}(?:child|guests?"
    r"|visitors?|person|man|woman|kids?|children|room"
    r"|tour|look|rest|pictures?|photos?|break|peek|lap|round|way|people|dog|cat|other)\b))"
    r"|.*\b(?:full speed|as fast as)\b",
    chooses=r"\bor\b",
)
_WAY = (
    r"去到进回来找查数转跟走巡带接停站靠绕逛溜过开看瞧盯睇返往朝驶等待留退移躲歇睡躺候陪抵穿搜环观"
    r"掉左右向原面后前直倒充领引问叫喊打跑探游导念说讲告"
)
CHINESE = ClauseWords.of(
    splits=r"[,，。；;！!？?：:|…~～]+|、|(?:然后|接着|随后|但是|但|不过|而是|因为)"
    r"|(?<=的话)(?!就)|(?<![别不])(?=再(?!见|说|次|也))|(?=否则|不然|要不然)"
    r"|(?=最后)|改去",
    opens=r"(?:那个|[这那][里儿边]|要不(?=[你您])|[能可]不[能可](?:以)?|快[点些]|慢?一[点些下]|慢[点些]"
    r"|[嗯哦啊喂嘿哎唉那请你您快先再"
    r"又也就都还得该\s]|那个|好[的了嘞](?!好)|不对|不是|是|对了|麻烦|拜托|劳驾|机器人|小家伙"
    r"|帮我?个?忙?"
    r"|给我|替我|赶紧|赶快|马上|立刻|现在|然后|接着|之后|最后|直接|最好|能不能|可不可以|可以|可否"
    r"|能否|能|应该|需要|要|记得|继续|慢慢地?|悄悄地?|自己|分别|依次|咱家|家里|顺便|一会儿?"
    r"|从[^,，去到]{1,8}(?=去|到)|完了|把[^,，]{1,4}(?=从|带|领|送|请)|让机器人|[在往向朝把从]"
    r"|咱们|用[^,，]{1,4}|按[^,，]{1,6}|以[^,，]{1,6}"
    r"|每[^,，去看]{1,4})",
    to_you=r"我(?:想|要|希望|需要)(?:让|叫|请)?[你您]|我(?:是|刚)?说(?:的是)?|我的意思是|改成|换成",
    orders=rf"(?!看起?来|看上去|看样子|回想|说[呢的不])(?:[{_WAY}]|检查|统计|访问|确认|移动|出发"
    rf"|[一二两三四五六七八九十\d](?!点)"
    r"|如果|要是|所有|每|全|整个|除了)",
    ways=r"(?!)",
    stays=r"[等待停站留](?![在到])|别|在这|说|讲|念|告诉",
    denies=r"别|不要|不用|不必|不许|不准|不能|不可|不该|不得|禁止|严禁|切勿|勿|甭|莫|不去|不进"
    r"|(?<![找看见听收想])不到|不是|不想|没必要|谁[让叫]|离.{1,8}远|不让|避开|绕开|绕过|跳过|排除"
    r"|除(?!了这)|没有.{0,6}允许|唔好|唔使|才不|谁都不|忘了(?!带)|算了",
    excepts=r"不是",
    no_denial=r"特别|别墅|分别|级别|性别|识别|类别|差别|不错|差不多|不锈钢|不好意思|对不起|了不起"
    r"|不客气|多少|不对|不少|至少|([^\s,.])[不没]\1|是否|能否|可否|能不能|可不可以"
    r"|(?:去|进|到|过|找|看|开)不(?:了|去|到|见|着)",
    hangs=r"[^,，]{0,4}(?:如果|要是|假如|万一|只要|除非|一旦|每当|若(?!干)|只有|当.{1,12}时)"
    r"|.*的话|(?:还|都)?(?:没|不)(?:在|有)(?:的话)?$",
    awaits=r"等(?!.{0,6}[秒分]).{2,}",
    polite=r"(?:如果|要是)(?:可以|方便|行|能)的?话?$",
    otherwise=r"(?:否则|要?不然|(?:没|不)(?:有|在)(?:的话)?(?=\W*$|[去到就]))",
    later=r"明天|今晚|每天|每晚|改天|待会儿?|晚点|下次|等会儿?(?!儿?再见)",
    past=r".*(?:[你您](?:刚|昨[天晚]|前天|上[回次]|之前|已经|早上|今天|平时|老是?|经过)|谢谢你|感谢"
    r"|多谢|辛苦|过(?:吗|没|了|的|$)|[你您][^,，]{0,4}真|到了[我你他她]|刚才|昨天|(?<!马)上[回次]"
    r"|从前"
    r"|去了?[的了]$|[往在]?哪|怎么?走|跑进|了[我你他她])",
    others=rf"(?:{NAMES_ZH}|孩子们?|宝宝们?|大家|同学们|妈妈?|爸爸?|[^\W\d]{{1,3}}们|人家|客人|护士"
    r"|医生|我|他|她|它|谁|有人|这(?![里边儿个间])|那(?!里|边|儿|个房间)|(?:[^你您]{1,4})(?=[你您](?:给我|快|去|来"
    r"|帮|先|到|过|绕))|[^\W\d]{1,3}(?:大爷|奶奶|阿姨|叔叔|老师|先生|太太|女士))",
    supposes=r"想象|假装|假设|我要是|要是我|如果我|也许|可能|或许|说不定|要不要|好不好|我们去"
    r"|^你会|有.{0,2}本事|会不会|要不是|就好了|更(?:喜欢|爱)|要不(?!然|要|你)|俗话|不如",
    asks=r".*(?:吗|呢|没有?$|什么|谁|哪|多少|几|怎|啥|[？?])|.*([^\W\d])[不没]\1",
    corrects=r"(?:不对|错了|不不|我说错|改|我是说)",
    speaks=r"(?<!听)(?<!我)(?<!我[是刚])[说喊讲念](?!一声|一下|明|的)|告诉(?!我)|转告|通知|提醒"
    r"|[问叫](?![问叫]?好)",
    beyond=r".*(?:全速|最快速度)|(?:[去到进]?)(?:把[^,，]{1,8}(?:打开|关|放|拿|递|端|扔|推|撞|倒)"
    r"|打扫|打开|关[上掉灯]|拿|洗碗"
    r"|倒[杯水茶]|端|递|撞|扔|搬|放[进到入在]|擦|收拾|做饭|烧)",
    chooses=r"还是|或者?",
)
