"""Own the reasons for which a model is not believed or not asked: stable codes, both languages.

They stand in a goal's record beside the brain that answered instead, and a page shows them.
"""

from __future__ import annotations

from planner.plan import Bilingual

REASONS: dict[str, Bilingual] = {
    code: Bilingual(en=en, zh=zh)
    for code, (en, zh) in {
        "timeout": ("The model did not answer in time.", "模型没有及时应答。"),
        "unreachable": ("The model's server can't be reached.", "无法连接模型服务器。"),
        "rate_limited": ("The model's server is taking no more calls now.", "模型服务器限流。"),
        "server_error": ("The model's server failed.", "模型服务器出错。"),
        "loading": (
            "The model's server is still loading the model.",
            "模型服务器仍在加载模型。",
        ),
        "bad_key": ("The model's server refused the key.", "模型服务器拒绝了密钥。"),
        "unknown_model": (
            "The server does not know the model or the address.",
            "服务器不认识该模型或地址。",
        ),
        "bad_request": ("The server refused the request.", "服务器拒绝了请求。"),
        "redirect": (
            "The server points elsewhere; redirects are not followed.",
            "服务器要求跳转；系统不会跟随。",
        ),
        "bad_reply": ("The server's reply could not be read.", "无法读取服务器的回复。"),
        "too_large": ("The server's reply was too large.", "服务器的回复过大。"),
        "refused_address": (
            "The model's address leads to a place that is never asked.",
            "模型地址指向禁止访问的位置。",
        ),
        "resting": (
            "The model failed several times and is given a rest.",
            "模型多次失败，暂停使用。",
        ),
        "pictures_offhost": (
            "The model is elsewhere, and the owner has not said that pictures may leave.",
            "模型在另一台机器上，而主人尚未允许图像离开本机。",
        ),
        "no_pictures": ("The model takes no pictures.", "该模型不接受图像。"),
        "bad_picture": ("The picture could not be read.", "无法读取图像。"),
        "picture_too_large": ("The picture is too large to be sent.", "图像过大，未发送。"),
        "bad_plan": ("The model wrote no usable plan.", "模型没有写出可用的计划。"),
        "out_of_budget": ("The model's budget is used up.", "模型预算已用完。"),
        "unavailable": ("The model is not available.", "模型不可用。"),
    }.items()
}


def reason(code: str) -> Bilingual:
    """Return the sentence of a code; one that is not listed reads as ``unavailable``."""
    return REASONS.get(code, REASONS["unavailable"])
