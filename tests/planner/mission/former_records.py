"""Hold goals' records as programs wrote them that kept one record, ``notes``, for every skill."""

# ruff: noqa: E501  # rows as they were written

from __future__ import annotations

YOUNGER = (
    *("recoveries", "depth", "role", "times", "round", "began_unix_s", "holds", "earlier"),
    *("word", "time", "after", "before", "span", "deeds", "bill"),
    *("look", "stops", "side", "map_id", "x_m", "y_m", "yaw_rad", "tool", "arguments"),
)
"""Fields of a step that these programs did not know."""

FIND = r"""
{"id":"g1","order":1,"text":"text g1","language":"en","state":"running","reason":null,"replies":
[],"questions":[],"source":"api","plan":{"kind":"plan","steps":[{"kind":"find","place":null,
"places":[],"object":"red cup","text":null,"seconds":null,"angle_rad":null,"distance_m":null,
"state":"running","reached":{"place":null,"room":"kitchen","x_m":3.975,"y_m":0.0,"yaw_rad":
1.0472},"residual_m":0.0,"residual_rad":0.0,"moved_m":null,"turned_rad":null,"visited":null,"x":
null,"y":null,"found":null,"count":null,"rooms":[],"code":null,"said":null,"read":null,"answer":
null,"left_m":null,"left_rad":null,"left_s":null,"reason":null}],"code":null,"text":null,
"options":[]},"outcome":null,"brain":null,"confirm":false,"replace":false,"first":false,
"doubtful_stop":false,"given_under_hold":null,"held":false,"kept":false,"map_id":"","step":0,
"part":14,"began_at":null,"done":3.975,"notes":{"stage":0,"spot":"kitchen/0","views":[0],
"turned":1,"spots":["here"],"rooms":["hall"],"missed":null,"shut":[],"broke":false,"here":[0.0,
0.0],"ahead":null,"faced":[],"order":["hall","kitchen"],"aim":null,"tried":[],"at":null,
"pointed":null,"sure":null,"label":null,"color":null,"stand":0,"again":0,"heard":null,"seen_s":
0.0},"step_s":13.45,"step_m":3.975,"replans":0,"decides":0,"tried":[
"[{\"angle_rad\": null, \"distance_m\": null, \"kind\": \"find\", \"object\": \"red cup\", \"place\": null, \"places\": [], \"seconds\": null, \"text\": null, \"x\": null, \"y\": null}]"
],"failure":null,"leg":7,"accepted_at":[0.0,0.0,0.0],"speed_share":1.0,"metres":3.975,"limited":
{"max_speed":158},"created_unix_s":100.19999999999999,"updated_unix_s":113.64999999999922}
"""

COUNT = r"""
{"id":"g1","order":1,"text":"text g1","language":"en","state":"running","reason":null,"replies":
[],"questions":[],"source":"api","plan":{"kind":"plan","steps":[{"kind":"count","place":null,
"places":[],"object":"cups","text":null,"seconds":null,"angle_rad":null,"distance_m":null,
"state":"running","reached":{"place":null,"room":"kitchen","x_m":3.975,"y_m":0.0,"yaw_rad":
-2.0944},"residual_m":0.0,"residual_rad":0.0,"moved_m":null,"turned_rad":null,"visited":null,"x":
null,"y":null,"found":null,"count":null,"rooms":[],"code":null,"said":null,"read":null,"answer":
null,"left_m":null,"left_rad":null,"left_s":null,"reason":null}],"code":null,"text":null,
"options":[]},"outcome":null,"brain":null,"confirm":false,"replace":false,"first":false,
"doubtful_stop":false,"given_under_hold":null,"held":false,"kept":false,"map_id":"","step":0,
"part":21,"began_at":null,"done":3.975,"notes":{"stage":0,"spot":"kitchen/0","views":[0,1,2,3,4],
"turned":null,"spots":["here"],"rooms":["hall"],"missed":null,"shut":[],"broke":false,"here":[
0.0,0.0],"ahead":null,"faced":[],"order":["hall","kitchen"],"aim":null,"tried":[],"at":null,
"pointed":null,"sure":null,"label":null,"color":null,"stand":0,"again":0,"heard":null,"seen_s":
0.0},"step_s":16.6,"step_m":3.975,"replans":0,"decides":0,"tried":[
"[{\"angle_rad\": null, \"distance_m\": null, \"kind\": \"count\", \"object\": \"cups\", \"place\": null, \"places\": [], \"seconds\": null, \"text\": null, \"x\": null, \"y\": null}]"
],"failure":null,"leg":11,"accepted_at":[0.0,0.0,0.0],"speed_share":1.0,"metres":3.975,"limited":
{"max_speed":158},"created_unix_s":100.19999999999999,"updated_unix_s":116.79999999999905}
"""

LOOK = r"""
{"id":"g1","order":1,"text":"text g1","language":"en","state":"running","reason":null,"replies":
[],"questions":[],"source":"api","plan":{"kind":"plan","steps":[{"kind":"look","place":null,
"places":[],"object":null,"text":"look around: is there a cup?","seconds":null,"angle_rad":null,
"distance_m":null,"state":"running","reached":{"place":null,"room":"hall","x_m":0.0,"y_m":0.0,
"yaw_rad":-1.0472},"residual_m":0.0,"residual_rad":0.0,"moved_m":null,"turned_rad":null,
"visited":null,"x":null,"y":null,"found":null,"count":null,"rooms":[],"code":null,"said":null,
"read":null,"answer":null,"left_m":null,"left_rad":null,"left_s":null,"reason":null}],"code":
null,"text":null,"options":[]},"outcome":null,"brain":null,"confirm":false,"replace":false,
"first":false,"doubtful_stop":false,"given_under_hold":null,"held":false,"kept":false,"map_id":
"","step":0,"part":10,"began_at":null,"done":0.0,"notes":{"stage":0,"spot":"here","views":[0,1,2,
3,4],"turned":5,"spots":[],"rooms":[],"missed":null,"shut":[],"broke":false,"here":[0.0,0.0],
"ahead":0.0,"faced":[0.0,1.047,2.094,3.142,-2.094],"order":["hall","kitchen"],"aim":null,"tried":
[],"at":null,"pointed":null,"sure":null,"label":null,"color":null,"stand":0,"again":0,"heard":
null,"seen_s":0.0},"step_s":4.05,"step_m":0.0,"replans":0,"decides":0,"tried":[
"[{\"angle_rad\": null, \"distance_m\": null, \"kind\": \"look\", \"object\": null, \"place\": null, \"places\": [], \"seconds\": null, \"text\": \"look around: is there a cup?\", \"x\": null, \"y\": null}]"
],"failure":null,"leg":5,"accepted_at":[0.0,0.0,0.0],"speed_share":1.0,"metres":0.0,"limited":{},
"created_unix_s":100.19999999999999,"updated_unix_s":104.24999999999976}
"""

FOLLOW = r"""
{"id":"g1","order":1,"text":"text g1","language":"en","state":"running","reason":null,"replies":
[],"questions":[],"source":"api","plan":{"kind":"plan","steps":[{"kind":"follow","place":null,
"places":[],"object":"me","text":null,"seconds":null,"angle_rad":null,"distance_m":null,"state":
"running","reached":null,"residual_m":null,"residual_rad":null,"moved_m":null,"turned_rad":null,
"visited":null,"x":null,"y":null,"found":null,"count":null,"rooms":[],"code":null,"said":null,
"read":null,"answer":null,"left_m":null,"left_rad":null,"left_s":null,"reason":null}],"code":
null,"text":null,"options":[]},"outcome":null,"brain":null,"confirm":false,"replace":false,
"first":false,"doubtful_stop":false,"given_under_hold":null,"held":false,"kept":false,"map_id":
"","step":0,"part":2,"began_at":null,"done":0.0,"notes":{"stage":-1,"spot":null,"views":[],
"turned":null,"spots":[],"rooms":[],"missed":null,"shut":[],"broke":false,"here":[0.0,0.0],
"ahead":null,"faced":[],"order":[],"aim":null,"tried":[],"at":[3.0,0.0,0.9],"pointed":null,
"sure":null,"label":"person","color":null,"stand":3,"again":0,"heard":null,"seen_s":6.9},
"step_s":6.9,"step_m":0.0,"replans":0,"decides":0,"tried":[
"[{\"angle_rad\": null, \"distance_m\": null, \"kind\": \"follow\", \"object\": \"me\", \"place\": null, \"places\": [], \"seconds\": null, \"text\": null, \"x\": null, \"y\": null}]"
],"failure":null,"leg":0,"accepted_at":[0.0,0.0,0.0],"speed_share":1.0,"metres":0.0,"limited":{},
"created_unix_s":100.19999999999999,"updated_unix_s":109.19999999999948}
"""

APPROACH = r"""
{"id":"g1","order":1,"text":"text g1","language":"en","state":"running","reason":null,"replies":
[],"questions":[],"source":"api","plan":{"kind":"plan","steps":[{"kind":"go_to_object","place":
null,"places":[],"object":"red cup","text":null,"seconds":null,"angle_rad":null,"distance_m":
null,"state":"running","reached":{"place":null,"room":"kitchen","x_m":4.125,"y_m":0.0,"yaw_rad":
0.0},"residual_m":0.0,"residual_rad":0.0,"moved_m":null,"turned_rad":null,"visited":null,"x":
null,"y":null,"found":null,"count":null,"rooms":[],"code":null,"said":null,"read":null,"answer":
null,"left_m":null,"left_rad":null,"left_s":null,"reason":null}],"code":null,"text":null,
"options":[]},"outcome":null,"brain":null,"confirm":false,"replace":false,"first":false,
"doubtful_stop":false,"given_under_hold":null,"held":false,"kept":false,"map_id":"","step":0,
"part":1,"began_at":null,"done":4.125,"notes":{"stage":11,"spot":null,"views":[],"turned":null,
"spots":[],"rooms":[],"missed":null,"shut":[],"broke":false,"here":null,"ahead":null,"faced":[],
"order":[],"aim":null,"tried":[],"at":[5.0,0.0,0.8],"pointed":null,"sure":null,"label":"cup",
"color":"red","stand":0,"again":0,"heard":null,"seen_s":0.0},"step_s":8.25,"step_m":4.125,
"replans":0,"decides":0,"tried":[
"[{\"angle_rad\": null, \"distance_m\": null, \"kind\": \"go_to_object\", \"object\": \"red cup\", \"place\": null, \"places\": [], \"seconds\": null, \"text\": null, \"x\": null, \"y\": null}]"
],"failure":null,"leg":1,"accepted_at":[0.0,0.0,0.0],"speed_share":1.0,"metres":4.125,"limited":
{"max_speed":164},"created_unix_s":101.19999999999993,"updated_unix_s":109.44999999999946}
"""

LOOK_ANEW = r"""
{"id":"g1","order":1,"text":"text g1","language":"en","state":"running","reason":null,"replies":
[],"questions":[],"source":"api","plan":{"kind":"plan","steps":[{"kind":"go_to_object","place":
null,"places":[],"object":"red cup","text":null,"seconds":null,"angle_rad":null,"distance_m":
null,"state":"running","reached":{"place":null,"room":"hall","x_m":0.025,"y_m":0.0,"yaw_rad":0.0
},"residual_m":0.0,"residual_rad":null,"moved_m":null,"turned_rad":null,"visited":null,"x":null,
"y":null,"found":null,"count":null,"rooms":[],"code":null,"said":null,"read":null,"answer":null,
"left_m":null,"left_rad":null,"left_s":null,"reason":null}],"code":null,"text":null,"options":[]
},"outcome":null,"brain":null,"confirm":false,"replace":false,"first":false,"doubtful_stop":
false,"given_under_hold":null,"held":false,"kept":false,"map_id":"","step":0,"part":14,
"began_at":null,"done":8.225,"notes":{"stage":0,"spot":"hall/0","views":[],"turned":null,"spots":
["here"],"rooms":["kitchen"],"missed":null,"shut":[],"broke":false,"here":[4.125,0.0],"ahead":
null,"faced":[],"order":["kitchen","hall"],"aim":null,"tried":[],"at":null,"pointed":null,"sure":
null,"label":"cup","color":"red","stand":0,"again":1,"heard":null,"seen_s":0.0},"step_s":22.4,
"step_m":8.225,"replans":0,"decides":0,"tried":[
"[{\"angle_rad\": null, \"distance_m\": null, \"kind\": \"go_to_object\", \"object\": \"red cup\", \"place\": null, \"places\": [], \"seconds\": null, \"text\": null, \"x\": null, \"y\": null}]"
],"failure":null,"leg":7,"accepted_at":[0.0,0.0,0.0],"speed_share":1.0,"metres":8.225,"limited":
{"max_speed":327},"created_unix_s":101.19999999999993,"updated_unix_s":123.59999999999866}
"""

POINTED = r"""
{"id":"g1","order":1,"text":"text g1","language":"en","state":"needs_clarification","reason":
"asked","replies":[],"questions":[],"source":"api","plan":{"kind":"plan","steps":[{"kind":
"go_to_object","place":null,"places":[],"object":"guitar","text":null,"seconds":null,"angle_rad":
null,"distance_m":null,"state":"running","reached":null,"residual_m":null,"residual_rad":null,
"moved_m":null,"turned_rad":null,"visited":null,"x":null,"y":null,"found":null,"count":null,
"rooms":[],"code":null,"said":null,"read":null,"answer":null,"left_m":null,"left_rad":null,
"left_s":null,"reason":null},{"kind":"go_to","place":"dock","places":[],"object":null,"text":
null,"seconds":null,"angle_rad":null,"distance_m":null,"state":"pending","reached":null,
"residual_m":null,"residual_rad":null,"moved_m":null,"turned_rad":null,"visited":null,"x":null,
"y":null,"found":null,"count":null,"rooms":[],"code":null,"said":null,"read":null,"answer":null,
"left_m":null,"left_rad":null,"left_s":null,"reason":null}],"code":null,"text":null,"options":[]
},"outcome":{"code":"asked","message":{"en":
"“guitar”: the vision model points 4.0 m away, straight ahead (in the kitchen). Shall I drive there?",
"zh":"“guitar”：视觉模型指向正前方 4.0 米处（kitchen）。要我开过去吗？"},"asked":null,"reached":null,"metres":null,
"seconds":null,"limited_by":[]},"brain":null,"confirm":false,"replace":false,"first":false,
"doubtful_stop":false,"given_under_hold":null,"held":false,"kept":false,"map_id":"","step":0,
"part":2,"began_at":null,"done":0.0,"notes":{"stage":4,"spot":null,"views":[],"turned":null,
"spots":[],"rooms":[],"missed":null,"shut":[],"broke":false,"here":null,"ahead":null,"faced":[],
"order":[],"aim":null,"tried":[],"at":null,"pointed":[4.0,0.5,0.4],"sure":null,"label":null,
"color":null,"stand":0,"again":0,"heard":null,"seen_s":0.0},"step_s":0.8,"step_m":0.0,"replans":
0,"decides":0,"tried":[
"[{\"angle_rad\": null, \"distance_m\": null, \"kind\": \"go_to_object\", \"object\": \"guitar\", \"place\": null, \"places\": [], \"seconds\": null, \"text\": null, \"x\": null, \"y\": null}, {\"angle_rad\": null, \"distance_m\": null, \"kind\": \"go_to\", \"object\": null, \"place\": \"dock\", \"places\": [], \"seconds\": null, \"text\": null, \"x\": null, \"y\": null}]"
],"failure":null,"leg":0,"accepted_at":[0.0,0.0,0.0],"speed_share":1.0,"metres":0.0,"limited":{},
"created_unix_s":100.19999999999999,"updated_unix_s":100.99999999999994}
"""

ASKED_AGAIN = r"""
{"id":"g1","order":1,"text":"text g1","language":"en","state":"needs_clarification","reason":
"asked","replies":[],"questions":[],"source":"api","plan":{"kind":"plan","steps":[{"kind":"ask",
"place":null,"places":[],"object":null,"text":"Shall I go?","seconds":null,"angle_rad":null,
"distance_m":null,"state":"running","reached":null,"residual_m":null,"residual_rad":null,
"moved_m":null,"turned_rad":null,"visited":null,"x":null,"y":null,"found":null,"count":null,
"rooms":[],"code":null,"said":null,"read":null,"answer":null,"left_m":null,"left_rad":null,
"left_s":null,"reason":null},{"kind":"go_to","place":"dock","places":[],"object":null,"text":
null,"seconds":null,"angle_rad":null,"distance_m":null,"state":"pending","reached":null,
"residual_m":null,"residual_rad":null,"moved_m":null,"turned_rad":null,"visited":null,"x":null,
"y":null,"found":null,"count":null,"rooms":[],"code":null,"said":null,"read":null,"answer":null,
"left_m":null,"left_rad":null,"left_s":null,"reason":null}],"code":null,"text":null,"options":[]
},"outcome":{"code":"asked","message":{"en":
"You said “perhaps”. Shall I drive to “dock”? Please answer yes or no.","zh":
"您说了“perhaps”。要我去“充电桩”吗？请回答“是”或“不”。"},"asked":null,"reached":null,"metres":null,"seconds":null,
"limited_by":[]},"brain":null,"confirm":false,"replace":false,"first":false,"doubtful_stop":
false,"given_under_hold":null,"held":false,"kept":false,"map_id":"","step":0,"part":0,"began_at":
null,"done":0.0,"notes":{"stage":2,"spot":null,"views":[],"turned":null,"spots":[],"rooms":[],
"missed":null,"shut":[],"broke":false,"here":null,"ahead":null,"faced":[],"order":[],"aim":null,
"tried":[],"at":null,"pointed":null,"sure":null,"label":null,"color":null,"stand":0,"again":0,
"heard":"perhaps","seen_s":0.0},"step_s":0.0,"step_m":0.0,"replans":0,"decides":0,"tried":[
"[{\"angle_rad\": null, \"distance_m\": null, \"kind\": \"ask\", \"object\": null, \"place\": null, \"places\": [], \"seconds\": null, \"text\": \"Shall I go?\", \"x\": null, \"y\": null}, {\"angle_rad\": null, \"distance_m\": null, \"kind\": \"go_to\", \"object\": null, \"place\": \"dock\", \"places\": [], \"seconds\": null, \"text\": null, \"x\": null, \"y\": null}]"
],"failure":null,"leg":0,"accepted_at":[0.0,0.0,0.0],"speed_share":1.0,"metres":0.0,"limited":{},
"created_unix_s":100.19999999999999,"updated_unix_s":101.19999999999993}
"""
