"""Own what is known of each class by itself: what it is called, how large it is, whether it walks.

One table: the classes of the default model first, then what detectors trained on COCO's 80 classes
add (Lin et al. 2014; their names are facts). Sizes are of ordinary things, to the nearest handful
of centimetres; they say where a middle lies behind what is seen, and from how far a miss counts.
"""

from __future__ import annotations

from dataclasses import dataclass

LARGE_M = 0.5
"""Things of at least this reach show by their sides, and may show as two boxes."""
READ_BEHIND_M, CUT_SHARE = 0.1, 0.8
"""The depth of what is large is read somewhat behind its front edge, on its seat or its top, and
still farther in where it is cut off. In 681 looks at large things of drawn homes their middles lay
0.04 to 0.34 m nearer than without, by class and cut."""
MIDDLE = (0.25, 0.25, 0.75, 0.75)
"""The part of a box that is most surely the thing: left, top, right, bottom, as shares."""
ENOUGH = 0.3
"""Share of that part which the thing has at least: a leg or a leaf before it has less."""


@dataclass(frozen=True, slots=True)
class Kind:
    """Describe one class."""

    id: str
    en: str
    zh: str
    also_en: tuple[str, ...] = ()
    """Other words that mean it; plurals are made of them."""
    also_zh: tuple[str, ...] = ()
    reach_m: float = 0.15
    """Half of its greatest extent on the floor plane."""
    behind_m: float = 0.10
    """How far its middle lies behind the surface that is seen, from its broad side."""
    height_m: float = 0.30
    perched: bool = False
    """It often stands on something: the foot of its box need not be on the floor."""
    mobile: bool = False
    """It walks by itself."""
    least_m: tuple[float, float] = (0.0, 0.0)
    """Width and height that every one of it has; 0 where that is not known."""

    part: tuple[float, float, float, float] = MIDDLE
    """Where in its box its depth is read."""
    enough: float = ENOUGH

    def middle_m(self, width_m: float, *, cut: bool = False) -> float:
        """Return how far its middle lies behind where its depth is read [m].

        What is large shows its broad side or its narrow one: a box of sides L and S, turned
        anyhow, shows about as much more in width as it has less in depth.

        Args:
            width_m: so wide as it shows.
            cut: the picture's edge cuts it off: nobody knows which side that is.
        """
        if self.reach_m < LARGE_M:
            narrow = self.reach_m < 0.2 and not cut
            return min(self.behind_m, width_m / 2) if narrow else self.behind_m
        if cut:
            return CUT_SHARE * self.behind_m
        behind_m = self.reach_m + self.behind_m - width_m / 2
        return min(max(behind_m, self.behind_m), self.reach_m) - READ_BEHIND_M

    def nearest_m(self, width_px: float, height_px: float, focal_px: float) -> float:
        """Return how far away a box of it must be at least [m]; 0 where nobody can tell.

        It may be hidden in part: then one of width and height shows whole.
        """
        if not (width_px > 0.0 and height_px > 0.0):
            return 0.0
        return focal_px * min(self.least_m[0] / width_px, self.least_m[1] / height_px)


def _k(
    names: str,
    sizes: tuple[float, float, float] = (0.15, 0.10, 0.30),
    *,
    perched: bool = False,
    mobile: bool = False,
    least_m: tuple[float, float] = (0.0, 0.0),
    part: tuple[float, float, float, float] = MIDDLE,
    enough: float = ENOUGH,
) -> Kind:
    """Return a kind of "id; English, synonyms; Chinese, synonyms" and (reach, behind, height)."""
    id_, en, zh = (part.strip() for part in names.split(";"))
    english, chinese = ([w.strip() for w in part.split(",")] for part in (en, zh))
    return Kind(
        id_, english[0], chinese[0], tuple(english[1:]), tuple(chinese[1:]),
        *sizes, perched=perched, mobile=mobile, least_m=least_m, part=part, enough=enough,
    )  # fmt: skip


TOP = (0.15, 0.03, 0.85, 0.45)
"""Of what stands on legs: below, one looks through it, or something stands before it."""
HIGH = (0.30, 0.05, 0.70, 0.50)
_CUTLERY = (0.10, 0.02, 0.03)
_FRUIT = (0.06, 0.04, 0.08)
_FOOD = (0.10, 0.06, 0.08)
_VEHICLE = (2.2, 0.9, 1.6)
_ANIMAL = (0.9, 0.4, 1.3)

HOME: tuple[Kind, ...] = (
    _k("person; person, human, man, woman, boy, girl, child, kid, baby, guy, lady, gentleman, "
       "somebody, someone, anybody, anyone, visitor, guest, adult, people, folk; "
       "人, 人们, 有人, 谁, 人员, 人类, 行人, 男人, 女人, 男的, 女的, 男孩, 女孩, 男孩子, 女孩子, "
       "小孩, 小孩子, 孩子, 小朋友, 老人, 老人家, 客人, 访客, 先生, 女士, 婴儿, 宝宝",
       (0.30, 0.12, 1.65), mobile=True, part=HIGH, least_m=(0.25, 0.9)),
    _k("chair; chair, seat, stool, armchair; 椅子, 椅, 座椅, 凳子, 扶手椅", (0.30, 0.04, 0.90),
       part=TOP, enough=0.15, least_m=(0.30, 0.70)),
    _k("sofa; sofa, couch, settee; 沙发, 长沙发, 沙发椅", (1.05, 0.42, 0.80), least_m=(0.7, 0.6)),
    _k("table; table, desk, dining table, diningtable, coffee table; "
       "桌子, 桌, 餐桌, 饭桌, 茶几, 书桌, 写字台", (0.65, 0.33, 0.70), part=TOP, enough=0.2),
    _k("bed; bed; 床, 床铺, 大床", (1.05, 0.80, 0.50), least_m=(0.8, 0.35)),
    _k("tv; tv, television, telly, tv set, tvmonitor, tv monitor, monitor, screen; "
       "电视, 电视机, 显示器, 屏幕", (0.55, 0.05, 0.60), perched=True),
    _k("fridge; fridge, refrigerator, icebox; 冰箱, 电冰箱, 雪柜", (0.40, 0.33, 1.70),
       least_m=(0.45, 0.8)),
    _k("plant; plant, potted plant, pottedplant, houseplant, flowerpot; "
       "植物, 盆栽, 绿植, 盆景, 花盆, 花草", (0.22, 0.18, 0.80)),
    _k("door; door; 门, 房门", (0.45, 0.03, 2.00), least_m=(0.0, 1.8)),
    _k("box; box, carton, package, parcel, cardboard box, crate; "
       "箱子, 盒子, 纸箱, 纸盒, 包裹, 箱, 盒", (0.20, 0.14, 0.28)),
    _k("cup; cup, mug, teacup, coffee cup, tumbler; "
       "杯子, 杯, 水杯, 茶杯, 马克杯, 咖啡杯", (0.05, 0.04, 0.10), perched=True),
    _k("ball; ball, sports ball, football, soccer ball, basketball; "
       "球, 皮球, 足球, 篮球, 小球", (0.12, 0.10, 0.20)),
    _k("bottle; bottle, water bottle; 瓶子, 瓶, 水瓶, 酒瓶", (0.05, 0.04, 0.26), perched=True),
    _k("book; book, novel, textbook; 书, 书本, 书籍, 图书", (0.13, 0.05, 0.10), perched=True),
)  # fmt: skip

COCO: tuple[Kind, ...] = (
    _k("bicycle; bicycle, bike; 自行车, 单车", (0.85, 0.30, 1.00)),
    _k("car; car, automobile; 汽车, 小汽车, 轿车", _VEHICLE),
    _k("motorcycle; motorcycle, motorbike; 摩托车, 摩托", (1.05, 0.35, 1.10)),
    _k("airplane; airplane, aeroplane, plane; 飞机", (5.0, 2.0, 4.0)),
    _k("bus; bus; 公交车, 公共汽车, 巴士, 大巴", (5.0, 1.3, 3.0)),
    _k("train; train; 火车, 列车", (10.0, 1.5, 3.5)),
    _k("truck; truck, lorry; 卡车, 货车", (3.5, 1.2, 2.8)),
    _k("boat; boat, ship; 船, 小船", (2.5, 1.0, 1.5)),
    _k("traffic_light; traffic light; 红绿灯, 交通灯", (0.20, 0.12, 0.80), perched=True),
    _k("fire_hydrant; fire hydrant, hydrant; 消防栓, 消火栓", (0.20, 0.15, 0.75)),
    _k("stop_sign; stop sign; 停车标志, 停止标志", (0.38, 0.03, 0.75), perched=True),
    _k("parking_meter; parking meter; 停车计时器, 停车收费表", (0.15, 0.10, 1.30)),
    _k("bench; bench; 长椅, 长凳, 板凳", (0.60, 0.22, 0.50)),
    _k("bird; bird; 鸟, 小鸟", (0.12, 0.06, 0.15), perched=True, mobile=True),
    _k("cat; cat, kitten; 猫, 小猫, 猫咪", (0.25, 0.10, 0.28), mobile=True),
    _k("dog; dog, puppy; 狗, 小狗, 狗狗", (0.40, 0.14, 0.50), mobile=True),
    _k("horse; horse; 马", _ANIMAL, mobile=True),
    _k("sheep; sheep; 羊, 绵羊", (0.55, 0.25, 0.80), mobile=True),
    _k("cow; cow; 牛, 奶牛", _ANIMAL, mobile=True),
    _k("elephant; elephant; 大象", (2.2, 1.0, 2.8), mobile=True),
    _k("bear; bear; 熊", _ANIMAL, mobile=True),
    _k("zebra; zebra; 斑马", _ANIMAL, mobile=True),
    _k("giraffe; giraffe; 长颈鹿", (1.2, 0.5, 4.5), mobile=True),
    _k("backpack; backpack, rucksack, schoolbag; 背包, 书包, 双肩包", (0.20, 0.13, 0.45)),
    _k("umbrella; umbrella; 雨伞, 伞", (0.35, 0.10, 0.60)),
    _k("handbag; handbag, purse, bag; 手提包, 手袋, 包, 包包", (0.18, 0.08, 0.28), perched=True),
    _k("tie; tie, necktie; 领带", (0.10, 0.02, 0.50), perched=True),
    _k("suitcase; suitcase, luggage; 行李箱, 手提箱, 拉杆箱", (0.25, 0.15, 0.65)),
    _k("frisbee; frisbee; 飞盘", (0.14, 0.08, 0.04)),
    _k("skis; skis; 滑雪板, 双板", (0.80, 0.05, 0.15)),
    _k("snowboard; snowboard; 单板滑雪板", (0.75, 0.10, 0.20)),
    _k("kite; kite; 风筝", (0.50, 0.05, 0.60), perched=True),
    _k("baseball_bat; baseball bat; 棒球棒, 球棒", (0.42, 0.03, 0.08)),
    _k("baseball_glove; baseball glove; 棒球手套", (0.15, 0.08, 0.15), perched=True),
    _k("skateboard; skateboard; 滑板", (0.40, 0.10, 0.12)),
    _k("surfboard; surfboard; 冲浪板", (1.00, 0.10, 0.50)),
    _k("tennis_racket; tennis racket; 网球拍, 球拍", (0.34, 0.03, 0.25)),
    _k("wine_glass; wine glass, wineglass, goblet; 酒杯, 高脚杯", (0.04, 0.04, 0.20), perched=True),
    _k("fork; fork; 叉子, 餐叉", _CUTLERY, perched=True),
    _k("knife; knife; 刀, 刀子, 餐刀", _CUTLERY, perched=True),
    _k("spoon; spoon; 勺子, 汤匙, 勺", _CUTLERY, perched=True),
    _k("bowl; bowl; 碗", (0.09, 0.07, 0.08), perched=True),
    _k("banana; banana; 香蕉", _FRUIT, perched=True),
    _k("apple; apple; 苹果", _FRUIT, perched=True),
    _k("sandwich; sandwich; 三明治", _FOOD, perched=True),
    _k("orange; orange; 橙子, 橘子", _FRUIT, perched=True),
    _k("broccoli; broccoli; 西兰花", _FOOD, perched=True),
    _k("carrot; carrot; 胡萝卜", _FOOD, perched=True),
    _k("hot_dog; hot dog, hotdog; 热狗", _FOOD, perched=True),
    _k("pizza; pizza; 披萨, 比萨", (0.17, 0.12, 0.05), perched=True),
    _k("donut; donut, doughnut; 甜甜圈", _FRUIT, perched=True),
    _k("cake; cake; 蛋糕", (0.13, 0.10, 0.12), perched=True),
    _k("toilet; toilet, toilet bowl; 马桶, 坐便器", (0.35, 0.25, 0.60)),
    _k("laptop; laptop, notebook computer, notebook; 笔记本电脑, 笔记本, 手提电脑",
       (0.19, 0.10, 0.22), perched=True),
    _k("mouse; mouse, computer mouse; 鼠标", (0.06, 0.03, 0.04), perched=True),
    _k("remote; remote, remote control; 遥控器", (0.10, 0.02, 0.03), perched=True),
    _k("keyboard; keyboard; 键盘", (0.22, 0.07, 0.03), perched=True),
    _k("cell_phone; cell phone, cellphone, phone, mobile phone, smartphone; 手机, 电话",
       (0.08, 0.02, 0.08), perched=True),
    _k("microwave; microwave, microwave oven; 微波炉", (0.26, 0.18, 0.30), perched=True),
    _k("oven; oven, stove; 烤箱, 炉子", (0.32, 0.28, 0.80)),
    _k("toaster; toaster; 烤面包机, 面包机", (0.16, 0.10, 0.20), perched=True),
    _k("sink; sink, washbasin; 水槽, 洗手池, 洗手台, 水池", (0.30, 0.20, 0.30), perched=True),
    _k("clock; clock; 钟, 时钟, 闹钟, 挂钟", (0.15, 0.04, 0.30), perched=True),
    _k("vase; vase; 花瓶", (0.09, 0.08, 0.28), perched=True),
    _k("scissors; scissors; 剪刀", _CUTLERY, perched=True),
    _k("teddy_bear; teddy bear, teddy; 泰迪熊, 玩具熊, 毛绒熊", (0.18, 0.12, 0.35)),
    _k("hair_drier; hair drier, hair dryer, hairdryer; 吹风机, 电吹风", (0.12, 0.05, 0.20),
       perched=True),
    _k("toothbrush; toothbrush; 牙刷", (0.09, 0.01, 0.02), perched=True),
)  # fmt: skip

KINDS: dict[str, Kind] = {kind.id: kind for kind in (*HOME, *COCO)}


def kind_of(label: str) -> Kind:
    """Return what is known of a class; of one that is in no table, its bare name."""
    known = KINDS.get(label)
    plain = label.replace("_", " ")
    return known if known is not None else Kind(label, plain, plain)
