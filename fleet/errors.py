"""Name what the fleet refuses, by stable code, with a cure in English and Chinese."""

from __future__ import annotations

from typing import Any


class FleetError(Exception):
    """Refuse a request: a code of ``WORDS``, and what came or exists."""

    def __init__(self, code: str, detail: str = "", **facts: Any) -> None:
        super().__init__(f"{code}: {detail or tell(code, facts)['en']}")
        self.code, self.facts = code, facts
        self.status = WORDS[code][0]
        self.message = tell(code, facts)
        self.detail = detail or self.message["en"]


WORDS: dict[str, tuple[int, str, str]] = {
    "token_needed": (
        401,
        "This needs a token of the fleet: send Authorization: Bearer with it.",
        "需要车队的令牌：请在 Authorization: Bearer 中发送。",
    ),
    "operator_needed": (
        403,
        "This token may look and stop; orders need the operator's.",
        "此令牌只能查看和停止；下命令需要操作者的令牌。",
    ),
    "foreign_host": (
        403,
        "The fleet does not answer by this name; PONS_ALLOWED_HOSTS can add it.",
        "车队不以此名称应答；可用 PONS_ALLOWED_HOSTS 添加。",
    ),
    "foreign_origin": (403, "A page of another site may not ask this.", "其他网站的页面不得请求。"),
    "unsupported_media_type": (
        415,
        "Send the order as application/json.",
        "请以 application/json 发送。",
    ),
    "body_too_large": (413, "The request is too long.", "请求太长。"),
    "invalid_request": (422, "The request is not understood: {why}.", "无法理解请求：{why}。"),
    "unknown_map": (404, "No robot shows this map now.", "现在没有机器人使用这张地图。"),
    "unknown_route": (404, "There is no such address here.", "这里没有此地址。"),
    "no_order": (
        422,
        "Nothing is left to do but the name of who shall do it.",
        "只说了谁去做，没有说做什么。",
    ),
    "no_robots": (
        409,
        "There are no robots yet: pons fleet add https://ROBOT --token TOKEN.",
        "还没有机器人：请运行 pons fleet add https://机器人 --token 令牌。",
    ),
    "unknown_robot": (404, "No robot is called {name}; there are {known}.",
                      "没有叫 {name} 的机器人；现有 {known}。"),
    "unknown_mission": (404, "There is no mission {name}.", "没有任务 {name}。"),
    "idempotency_conflict": (
        409,
        "This Idempotency-Key came before with another order; use a new one.",
        "此 Idempotency-Key 已用于另一个命令；请换一个。",
    ),
    "not_asking": (409, "Mission {name} asks nothing now.", "任务 {name} 现在没有提问。"),
    "mission_ended": (409, "Mission {name} is over: {state}.", "任务 {name} 已结束：{state}。"),
    "not_silent": (
        409,
        "Robot {name} answers, so the mission can be cancelled there: leave give_up out.",
        "机器人 {name} 有应答，可以直接取消任务：请去掉 give_up。",
    ),
    "robot_silent": (
        503,
        "Robot {name} does not answer; nothing was done. Try again when it is back.",
        "机器人 {name} 没有应答；未做任何事。等它恢复后再试。",
    ),
    "robot_refused": (409, "Robot {name} refused: {why}", "机器人 {name} 拒绝：{why}"),
    "robot_known": (
        409,
        "This robot is known already as {name}; --again renews its token and certificate.",
        "此机器人已登记为 {name}；用 --again 更新令牌和证书。",
    ),
    "name_taken": (
        409,
        "Another robot is called {name} already; give this one a name with --name.",
        "已有另一台机器人叫 {name}；请用 --name 另取名字。",
    ),
    "bad_name": (
        422,
        "{name!r} can't be a robot's name here: letters, digits, - and _, and no word of address.",
        "{name!r} 不能作为机器人的名字：只用字母、数字、- 和 _，且不能是称呼词。",
    ),
    "token_refused": (
        403,
        "Robot {name} does not take this token; make one there: pons people add fleet"
        " --role dispatcher.",
        "机器人 {name} 不接受此令牌；请在它上面运行 pons people add fleet --role dispatcher。",
    ),
    "role_refused": (
        403,
        "This token is of role {role}; the fleet takes a dispatcher's, which can't arm or steer.",
        "此令牌的角色是 {role}；车队只用 dispatcher 的令牌，它不能上电或遥控。",
    ),
    "pin_mismatch": (
        409,
        "{name} shows another certificate than the pinned one: another robot answers there, or it"
        " has a new one. Compare with `pons tls` on the robot, then add it with --again.",
        "{name} 的证书与登记的不同：可能是另一台机器人，或换了证书。"
        "请与机器人上的 `pons tls` 对照，再用 --again 登记。",
    ),
    "certificate_dates": (
        409,
        "By this machine's clock the certificate of {name} is not valid now: set the clock here and"
        " there; a robot that is started again renews one that ends.",
        "按本机时钟，{name} 的证书现在无效：请校准两边的时钟；机器人重启时会更新将到期的证书。",
    ),
    "robot_mismatch": (
        409,
        "At the address of {name} the robot {found} answers; nothing is given to it.",
        "{name} 的地址上应答的是机器人 {found}；不会给它任务。",
    ),
    "tls_needed": (
        422,
        "{name} is reached without TLS, so anybody between could act as it; start the robot with"
        " `pons up --tls`. Without TLS only this machine's own robots can be added.",
        "{name} 没有使用 TLS，中间的任何人都能冒充它；请用 `pons up --tls` 启动机器人。",
    ),
    "card_unread": (
        502,
        "{name} has no card of what it can do that is read here (GET /v1/capabilities): update Pons"
        " there, or here.",
        "{name} 没有本机能读的能力卡（GET /v1/capabilities）：请升级那里或这里的 Pons。",
    ),
    "store_unavailable": (
        503,
        "The fleet's database does not answer, or its disk is full; nothing was accepted.",
        "车队的数据库没有应答，或磁盘已满；未接受任何命令。",
    ),
    "queue_full": (
        429,
        "{count} orders wait already; wait until some have ended.",
        "已有 {count} 个命令在等待；请等一些结束。",
    ),
    "watched_elsewhere": (
        200,
        "Another fleet service carries the missions and watches this robot; this one stands by.",
        "由另一个车队服务执行任务并关注此机器人；本服务待命。",
    ),
    "not_waiting": (
        409,
        "Mission {name} waits no more, so it can't be given to others.",
        "任务 {name} 已不在等待，不能改派。",
    ),
    "not_at_robot": (
        409,
        "Mission {name} is at no robot now: it waits, is on its way there, or is over.",
        "任务 {name} 现在不在机器人上：还在等待、正在送达或已结束。",
    ),
    "resume_at_robot": (
        409,
        "Robot {name} goes on only after a person with its key: use its page {known}, or"
        " `pons resume` there.",
        "机器人 {name} 需持钥匙的人才能继续：请用它的网页 {known}，或在那里运行 `pons resume`。",
    ),
    "which_home": (
        422,
        "Several homes have such a place: {known}. Which one?",
        "有几个家都有这个地方：{known}。是哪一个？",
    ),
    "unknown_order": (404, "There is no standing order {name}.", "没有定时命令 {name}。"),
    "standing_full": (
        429,
        "{count} standing orders are kept already; remove one.",
        "已有 {count} 个定时命令；请先删除一个。",
    ),
    "standing_time": (
        422,
        "{name!r} is no time: give a time of day as 19:00, or five fields of cron as 0 19 * * 1-5.",
        "{name!r} 不是时间：请用 19:00 这样的时刻，或 cron 的五个字段，如 0 19 * * 1-5。",
    ),
    "standing_often": (
        422,
        "{name!r} comes more often than every 5 minutes.",
        "{name!r} 的间隔短于 5 分钟。",
    ),
    "standing_stop": (
        422,
        "A stop can't be a standing order; stop at once instead.",
        "停止不能作为定时命令；请直接停止。",
    ),
    # What a mission waits for, or why it ended without a robot's outcome.
    "being_chosen": (200, "A robot is being chosen.", "正在选择机器人。"),
    "robots_busy": (200, "All robots that may go are busy.", "可去的机器人都在忙。"),
    "nobody_answers": (200, "No robot that may go answers.", "可去的机器人都没有应答。"),
    "nobody_can": (200, "No robot that may go can do this.", "可去的机器人都做不了。"),
    "robots_low": (
        200,
        "The robots that may go are low on battery.",
        "可去的机器人电量都低。",
    ),
    "quiet_hours": (
        200,
        "These are quiet hours: it begins when they end. Give it with confirm to begin now.",
        "现在是安静时段：结束后才开始。要马上开始，请带 confirm 重新下命令。",
    ),
    "room_taken": (
        200,
        "Another robot is in, or bound for, a room where one at a time may be.",
        "限一台机器人的房间里已有另一台，或另一台正要去。",
    ),
    "budget_spent": (
        200,
        "The models of all robots have spent the day's budget of the house; it begins again at 0:00"
        " UTC. An order as steps needs no model.",
        "所有机器人的模型已用完今天的预算；UTC 零点重新计算。按步骤给的命令不需要模型。",
    ),
    "paused_there": (
        200,
        "It is paused at {name} and goes on when a person resumes it.",
        "它在 {name} 上已暂停，由人恢复后才继续。",
    ),
    "too_late": (
        200,
        "The standing order could not begin in time and was left out.",
        "定时命令未能及时开始，本次已略过。",
    ),
    "was_off": (
        200,
        "The fleet was not running at this time; what is over is not made up.",
        "当时车队服务没有运行；错过的不会补做。",
    ),
    "day_skipped": (200, "This day was left out.", "这一天已设为略过。"),
    "standing_quiet": (
        200,
        "Its time lies in the quiet hours, so what moves would be left out.",
        "它的时间在安静时段内，需要移动的将被略过。",
    ),
    "stopped_first": (200, "It was stopped before it began.", "开始之前已被停止。"),
    "cancelled_first": (200, "It was cancelled before it began.", "开始之前已被取消。"),
    "ended_by_person": (
        200,
        "A person ended it while the robot was silent, which tells what it did when it is back.",
        "机器人失联时由人结束；等它恢复后再问它做了什么。",
    ),
    "goal_lost": (
        200,
        "The robot's journal does not know this goal any more; what was done is not known.",
        "机器人的日志已没有此目标；不知道做了什么。",
    ),
}  # fmt: skip


def tell(code: str, facts: dict[str, Any] | None = None) -> dict[str, str]:
    """Return the sentence of a code in both languages."""
    _, english, chinese = WORDS[code]
    given = facts or {}
    return {"en": english.format(**given), "zh": chinese.format(**given)}
