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


FILES: dict[str, tuple[str, str | bytes, str, int]] = {
    "not TOML": ("a.toml", 'en = "x"\nsteps = [\n', "skill_not_toml", 3),
    "an unknown key": ("a.toml", ROUTINE + "max_speed = 3\n", "skill_key", 3),
    "no steps": ("a.toml", 'en = "do the round"\n', "skill_stepless", 1),
    "a wrong type": ("a.toml", 'en = 3\nsteps = [{kind = "explore"}]\n', "skill_malformed", 1),
    "an unknown step": (
        "a.toml",
        'en = "fly round"\nsteps = [\n  {kind = "explore"},\n  {kind = "fly"},\n]\n',
        "skill_step",
        4,
    ),
    "a velocity": (
        "a.toml",
        'en = "race round"\nsteps = [{kind = "move", distance_m = 1.0, v_mps = 3.0}]\n',
        "skill_step",
        2,
    ),
    "a point of the map": (
        "a.toml",
        'en = "race there"\nsteps = [{kind = "go_to_pose", map_id = "0", x_m = 1, y_m = 1}]\n',
        "skill_step",
        2,
    ),
    "a place that does not exist": (
        "a.toml",
        (
            'en = "do the round"\nsteps = [\n {kind = "wait", seconds = 1},\n'
            ' {kind = "go_to", place = "moon"}]'
        ),
        "skill_place",
        4,
    ),
    "a skill in a skill": (
        "a.toml",
        'en = "do the round"\nsteps = [{kind = "use_skill", name = "a"}]\n',
        "skill_nested",
        2,
    ),
    "a skill in a repeat": (
        "a.toml",
        'en = "do it"\nsteps = [{kind = "repeat", steps = [{kind = "use_skill", name = "a"}]}]\n',
        "skill_nested",
        2,
    ),
    "a blank of no parameter": (
        "a.toml",
        'en = "do the round"\nsteps = [{kind = "say", text = "in {where}"}]\n',
        "skill_blank",
        2,
    ),
    "too many steps": (
        "a.toml",
        'en = "do the round"\nsteps = [' + '{kind = "return_home"},' * 21 + "]\n",
        "skill_step",
        2,
    ),
    "no words": ("a.toml", 'steps = [{kind = "explore"}]\n', "skill_wordless", 1),
    "words that stop": (
        "stop.toml",
        ROUTINE.replace("do the evening round", "stop"),
        "skill_words_taken",
        1,
    ),
    "Chinese words that stop": (
        "a.toml",
        ROUTINE.replace('en = "do the evening round', 'zh = "停下'),
        "skill_words_taken",
        1,
    ),
    "words that are a place": (
        "kitchen.toml",
        ROUTINE.replace("do the evening round", "the kitchen"),
        "skill_words_taken",
        1,
    ),
    "words that are an order": (
        "a.toml",
        ROUTINE.replace("do the evening round", "go to the bedroom"),
        "skill_words_taken",
        1,
    ),
    "words that are a yes": (
        "a.toml",
        ROUTINE.replace("do the evening round", "yes"),
        "skill_words_taken",
        1,
    ),
    "words that command": (
        "a.toml",
        ROUTINE.replace("do the evening round", "go on"),
        "skill_words_taken",
        1,
    ),
    "words that deny": (
        "a.toml",
        ROUTINE.replace("do the evening round", "do not rest"),
        "skill_words_taken",
        1,
    ),
    "words that do harm": (
        "a.toml",
        ROUTINE.replace("do the evening round", "hit the wall"),
        "skill_unheard",
        1,
    ),
    "an open sentence": (
        "a.toml",
        'en = "[do] {what}"\n' + SAYS.replace("KIND", "words"),
        "skill_words",
        1,
    ),
    "a sentence without its parameter": (
        "a.toml",
        'en = "praise [{what}]"\n' + SAYS.replace("KIND", "words"),
        "skill_words",
        1,
    ),
    "an unknown kind of parameter": (
        "a.toml",
        'en = "praise {what}"\n' + SAYS.replace("KIND", "speed"),
        "skill_malformed",
        4,
    ),
    "brackets that do not close": (
        "a.toml",
        ROUTINE.replace("evening", "(evening"),
        "skill_words",
        1,
    ),
    "a name in other letters": ("еvening.toml", ROUTINE, "skill_name", 1),
    "a name with a path": ("..a.toml", ROUTINE, "skill_name", 1),
    "a character that nobody sees": ("a.toml", "# fine \u202e\n" + ROUTINE, "skill_unseen", 1),
    "no UTF-8": ("a.toml", b'en = "\xff"\n', "skill_unreadable", 1),
    "a long file": ("a.toml", ROUTINE + "#" * 40_000, "skill_long", 1),
    "deep nesting": ("a.toml", 'en = "x"\nsteps = ' + "[" * 5_000, "skill_not_toml", 2),
    "not Python": ("a.py", 'def f() -> str:\n    return "\n', "skill_not_python", 2),
    "two functions": ("a.py", "def a() -> str: ...\ndef b() -> str: ...\n", "skill_functions", 2),
    "an async function": ("a.py", "async def a() -> str: ...\n", "skill_functions", 1),
    "no types": (
        "a.py",
        'def a(where) -> str:\n    """x\n\n    en: praise {where}\n    """\n',
        "skill_untyped",
        1,
    ),
    "no answer's type": (
        "a.py",
        'def a():\n    """x\n\n    en: praise it\n    """\n',
        "skill_parameters",
        1,
    ),
    "a default that is worked out": (
        "a.py",
        'def a(x: str = open("y").read()) -> str:\n    ...\n',
        "skill_default",
        1,
    ),
    "a function without words": ("a.py", function("return 'x'", words="-"), "skill_wordless", 1),
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
