"""Hold skills that are wrong, each with its code and the line that is told of it."""

from __future__ import annotations

ROUTINE = 'en = "do the evening round"\nsteps = [{kind = "go_to", place = "kitchen"}]\n'
SAYS = 'steps = [{kind = "say", text = "{what}"}]\n[parameters]\nwhat = "KIND"\n'


def function(body: str, *, words: str = "en: water the plants") -> str:
    """Return the file of a function with this body, which begins on line 6."""
    lines = "\n".join(f"    {line}" for line in body.splitlines())
    return (
        f'def plants() -> list:\n    """Look after the plants.\n\n    {words}\n    """\n{lines}\n'
    )


def _heard(words: str) -> str:
    """Return the file of a routine that is heard by these words."""
    return ROUTINE.replace("do the evening round", words)


def _does(steps: str) -> str:
    """Return the file of a routine of these steps."""
    return f'en = "do the round"\nsteps = {steps}\n'


def _praises(words: str, kind: str = "words") -> str:
    """Return the file of a routine with a parameter of a kind, heard by these words."""
    return f'en = "{words}"\n' + SAYS.replace("KIND", kind)


_POSE = '[{kind = "go_to_pose", map_id = "0", x_m = 1, y_m = 1}]'
_CALL = '{kind = "use_skill", name = "a"}'
_MOON = '[\n {kind = "wait", seconds = 1},\n {kind = "go_to", place = "moon"}]'

ROUTINES: dict[str, tuple[str | bytes, str, int]] = {
    "not TOML": ('en = "x"\nsteps = [\n', "skill_not_toml", 3),
    "an unknown key": (ROUTINE + "max_speed = 3\n", "skill_key", 3),
    "no steps": ('en = "do the round"\n', "skill_stepless", 1),
    "a wrong type": ('en = 3\nsteps = [{kind = "explore"}]\n', "skill_malformed", 1),
    "an unknown step": (_does('[\n {kind = "explore"},\n {kind = "fly"},\n]'), "skill_step", 4),
    "a velocity": (_does('[{kind = "move", distance_m = 1.0, v_mps = 3.0}]'), "skill_step", 2),
    "a point of the map": (_does(_POSE), "skill_step", 2),
    "a place that does not exist": (_does(_MOON), "skill_place", 4),
    "a skill in a skill": (_does(f"[{_CALL}]"), "skill_nested", 2),
    "a skill in a repeat": (_does(f'[{{kind = "repeat", steps = [{_CALL}]}}]'), "skill_nested", 2),
    "a blank of no parameter": (_does('[{kind = "say", text = "in {where}"}]'), "skill_blank", 2),
    "too many steps": (_does("[" + '{kind = "return_home"},' * 21 + "]"), "skill_step", 2),
    "no words": ('steps = [{kind = "explore"}]\n', "skill_wordless", 1),
    "words that stop": (_heard("stop"), "skill_words_taken", 1),
    "Chinese words that stop": (
        ROUTINE.replace('en = "do the evening round', 'zh = "停下'),
        "skill_words_taken",
        1,
    ),
    "words that are a place": (_heard("the kitchen"), "skill_words_taken", 1),
    "words that are an order": (_heard("go to the bedroom"), "skill_words_taken", 1),
    "words that are a yes": (_heard("yes"), "skill_words_taken", 1),
    "words that command": (_heard("go on"), "skill_words_taken", 1),
    "words that deny": (_heard("do not rest"), "skill_words_taken", 1),
    "words that do harm": (_heard("hit the wall"), "skill_unheard", 1),
    "an open sentence": (_praises("[do] {what}"), "skill_words", 1),
    "a sentence without its parameter": (_praises("praise [{what}]"), "skill_words", 1),
    "an unknown kind of parameter": (_praises("praise {what}", "speed"), "skill_malformed", 4),
    "brackets that do not close": (ROUTINE.replace("evening", "(evening"), "skill_words", 1),
    "a character that nobody sees": ("# fine \u202e\n" + ROUTINE, "skill_unseen", 1),
    "no UTF-8": (b'en = "\xff"\n', "skill_unreadable", 1),
    "a long file": (ROUTINE + "#" * 40_000, "skill_long", 1),
    "deep nesting": ('en = "x"\nsteps = ' + "[" * 5_000, "skill_not_toml", 2),
}
"""By what is wrong in a routine: its text, the code, the line."""

FUNCTIONS: dict[str, tuple[str, str, int]] = {
    "not Python": ('def f() -> str:\n    return "\n', "skill_not_python", 2),
    "two functions": ("def a() -> str: ...\ndef b() -> str: ...\n", "skill_functions", 2),
    "an async function": ("async def a() -> str: ...\n", "skill_functions", 1),
    "no types": (
        'def a(where) -> str:\n    """x\n\n    en: praise {where}\n    """\n',
        "skill_untyped",
        1,
    ),
    "no answer's type": (
        'def a():\n    """x\n\n    en: praise it\n    """\n',
        "skill_parameters",
        1,
    ),
    "a default that is worked out": (
        'def a(x: str = open("y").read()) -> str:\n    ...\n',
        "skill_default",
        1,
    ),
    "a function without words": (function("return 'x'", words="-"), "skill_wordless", 1),
}
"""By what is wrong in a function that is never run: its text, the code, the line."""

FILES: dict[str, tuple[str, str | bytes, str, int]] = {
    **{what: ("a.toml", *rest) for what, rest in ROUTINES.items()},
    **{what: ("a.py", *rest) for what, rest in FUNCTIONS.items()},
    "a name that stops": ("stop.toml", _heard("stop"), "skill_words_taken", 1),
    "a name that is a place": ("kitchen.toml", _heard("the kitchen"), "skill_words_taken", 1),
    "a name in other letters": ("еvening.toml", ROUTINE, "skill_name", 1),
    "a name with a path": ("..a.toml", ROUTINE, "skill_name", 1),
}
"""By what is wrong: the file's name, its text, the code, the line."""

RUNS: dict[str, tuple[str, str, int]] = {
    "an endless loop": ("while True: pass", "skill_slow", 1),
    "a sleep": ("import time\ntime.sleep(60)", "skill_slow", 1),
    "2 GB": ("return 'x' * (2 << 30)", "skill_memory", 6),
    "2 GB by and by": ("a = []\nwhile True: a.append('x' * 1_000_000)", "skill_memory", 7),
    "a socket": ("import socket\nsocket.socket()", "skill_module", 6),
    "a socket by another way": ("return str(__import__('_socket').socket())", "skill_raised", 6),
    "a socket by ctypes": (
        (
            "import json\nc = __import__('sys').modules['ctypes'].CDLL(None)\n"
            "if c.socket(1, 1, 0) < 0: raise OSError('shut')"
        ),
        "skill_raised",
        8,
    ),
    "the bridge's socket": ("return open('{home}/sockets/bridge').read()", "skill_raised", 6),
    "the journal": ("open('{home}/missions.db', 'wb').write(b'')\nreturn 'x'", "skill_raised", 6),
    "the journal by its number": ("__import__('os').ftruncate(7, 0)", "skill_raised", 6),
    "a fork bomb": ("while True: __import__('os').fork()", "skill_raised", 6),
    "threads without end": (
        "while True: __import__('_thread').start_new_thread(print, ())",
        "skill_raised",
        6,
    ),
    "another program": ("__import__('os').execv('/bin/sh', ['sh'])", "skill_raised", 6),
    "the planner's end": (
        "__import__('os').kill(__import__('os').getppid(), 9)",
        "skill_raised",
        6,
    ),
    "more rights": (
        "import json\nr = __import__('resource')\nr.setrlimit(r.RLIMIT_AS, (1 << 40, 1 << 40))",
        "skill_raised",
        8,
    ),
    "a module of its own": ("import requests", "skill_module", 6),
    "its own end": ("raise SystemExit(0)", "skill_raised", 6),
    "an end without a word": ("__import__('os')._exit(0)", "skill_died", 1),
    "a call of itself": ("return plants()", "skill_raised", 6),
    "a wrong type": ("return 3", "skill_result", 1),
    "nothing": ("return []", "skill_result", 1),
    "a velocity": ("return [dict(kind='move', distance_m=1.0, v_mps=3.0)]", "skill_step", 1),
    "a twist": ("return [dict(v_mps=3.0, w_radps=1.0)]", "skill_step", 1),
    "an unknown step": ("return [dict(kind='fly')]", "skill_step", 1),
    "a point of the map": (
        "return [dict(kind='go_to_pose', map_id='0', x_m=1.0, y_m=1.0)]",
        "skill_step",
        1,
    ),
    "a skill": ("return [dict(kind='use_skill', name='plants')]", "skill_step", 1),
    "no number": ("return [dict(kind='wait', seconds=float('nan'))]", "skill_raised", 1),
    "a flood": ("return 'x' * 1_000_000", "skill_result_long", 1),
    "long words": ("return 'x' * 501", "skill_result", 1),
    "an answer that it forges": (
        (
            "to = int(__import__('sys').argv[1])\n"
            "__import__('os').write(to, b'{\"code\": \"skill_zzz\"}')\n__import__('os')._exit(0)"
        ),
        "skill_died",
        1,
    ),
}
"""By what is wrong: the function's body, the code, the line."""
