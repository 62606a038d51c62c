"""Be a robot's door to a fleet: a real server with a real journal on disk, which may be killed.

``python -m tests.fleet.robot_stub FOLDER NAME PORT [HOST PEM]``. It shares no code with Pons. Its
journal says what was begun, so that a judge who reads the file alone can tell whether anything was
done twice. POST /stub changes how it behaves: to lose answers, to work for longer, to ask, to want
a token, to be hostile.
"""

from __future__ import annotations

import base64
import hashlib
import json
import os
import sqlite3
import ssl
import sys
import threading
import time
import uuid
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

ENDED = ("succeeded", "failed", "refused", "cancelled")
MAP = "00112233445566aa"
OUTLINES = {"kitchen": [[0, 0], [4, 0], [4, 4], [0, 4]], "hall": [[4, 0], [8, 0], [8, 4], [4, 4]]}
MAPS: dict[str, Any] = {
    "whole": {"map_id": MAP, "width": 60, "height": 40, "resolution_m": 0.1,
              "origin": {"x_m": -1.0, "y_m": -1.0}, "growing": None,
              "cells": base64.b64encode(bytes(60) + b"\x01" * 60 + bytes(60 * 38)).decode(),
              "fence": {"allowed": [], "keep_outs": [], "speed_zones": []}},
    "garbage": {"map_id": MAP, "width": 4e9, "height": "<b>", "cells": {"a": [None]}},
    "endless": {},
}  # fmt: skip
SCHEMA = """
CREATE TABLE IF NOT EXISTS keys (key TEXT PRIMARY KEY, body TEXT, goal TEXT, at_unix_s REAL);
CREATE TABLE IF NOT EXISTS goals (id TEXT PRIMARY KEY, text TEXT, state TEXT, record TEXT);
CREATE TABLE IF NOT EXISTS changes (seq INTEGER PRIMARY KEY AUTOINCREMENT, goal TEXT, state TEXT);
CREATE TABLE IF NOT EXISTS acts
  (seq INTEGER PRIMARY KEY AUTOINCREMENT, act TEXT, goal TEXT, key TEXT);
"""


class Journal:
    """Keep goals on disk, and move them on."""

    def __init__(self, folder: Path, name: str) -> None:
        self.name, self.lock = name, threading.Lock()
        self.rules: dict[str, Any] = {
            "work_s": 0.05, "lose_answers": 0, "ask": False, "token": "", "id": name,
            "length_m": 5.0, "refuse": None, "role": "dispatcher", "places": ["kitchen", "hall"],
            "resume": False, "card": {},
            "camera": None, "site": "home", "map_id": MAP, "languages": ["en", "zh"],
            "room": "cellar", "battery": None, "orders": [], "does": "drives", "through": [],
            "model": None, "money": 0.0, "proof": False,
            "evil": None, "clock_s": 0.0,
            "map": "whole", "question": "Which door?", "status": {},
        }  # fmt: skip
        self.disk = sqlite3.connect(
            folder / f"{name}.journal", check_same_thread=False, isolation_level=None
        )
        self.disk.execute("PRAGMA journal_mode=WAL")
        self.disk.execute("PRAGMA synchronous=FULL")
        self.disk.executescript(SCHEMA)
        self.since: dict[str, float] = {}
        self.is_stopped = False

    def give(self, body: dict[str, Any], key: str | None) -> tuple[int, dict[str, Any]]:
        """Take a goal, or find the one that the same key made."""
        print_of_it = hashlib.sha256(json.dumps(body, sort_keys=True).encode()).hexdigest()
        if key is not None:
            row = self.disk.execute("SELECT body, goal FROM keys WHERE key=?", (key,)).fetchone()
            if row is not None and row[0] != print_of_it:
                return 409, problem("idempotency_conflict")
            if row is not None:
                return 202, self.goal(row[1])
        goal_id = uuid.uuid4().hex
        points = [step for step in body.get("steps") or () if step["kind"] == "go_to_pose"]
        maps = {body["map_id"]} if "points" in body else {step["map_id"] for step in points}
        is_of_other_map = not maps <= {self.rules["map_id"]}
        state = "refused" if is_of_other_map else "queued"
        text = body.get("text") or json.dumps(body.get("steps") or body.get("points"))
        now = time.time() + self.rules["clock_s"]
        record = {"id": goal_id, "text": text, "state": state, "reason": None, "plan": None,
                  "created_unix_s": now, "updated_unix_s": now,
                  "outcome": outcome(state) if state in ENDED else None}  # fmt: skip
        self.disk.execute("BEGIN IMMEDIATE")
        if key is not None:
            self.disk.execute("INSERT INTO keys VALUES (?,?,?,?)",
                              (key, print_of_it, goal_id, time.time()))  # fmt: skip
        self.disk.execute(
            "INSERT INTO goals VALUES (?,?,?,?)", (goal_id, text, state, json.dumps(record))
        )
        self.disk.execute("INSERT INTO changes (goal, state) VALUES (?,?)", (goal_id, state))
        self.disk.execute("COMMIT")
        return 202, record

    def goal(self, goal_id: str) -> dict[str, Any]:
        row = self.disk.execute("SELECT record FROM goals WHERE id=?", (goal_id,)).fetchone()
        found: dict[str, Any] = json.loads(row[0]) if row else {}
        return found

    def move(self, goal_id: str, state: str, **more: Any) -> dict[str, Any]:
        """Write a goal's next state down, and what was begun."""
        record = {**self.goal(goal_id), "state": state, **more}
        if state in ENDED:
            record["outcome"] = outcome(state)
        self.disk.execute("BEGIN IMMEDIATE")
        self.disk.execute(
            "UPDATE goals SET state=?, record=? WHERE id=?", (state, json.dumps(record), goal_id)
        )
        self.disk.execute("INSERT INTO changes (goal, state) VALUES (?,?)", (goal_id, state))
        if state == "running" and "answered" not in more:
            key = self.disk.execute("SELECT key FROM keys WHERE goal=?", (goal_id,)).fetchone()
            act = ("begun", goal_id, key[0] if key else None)
            self.disk.execute("INSERT INTO acts (act, goal, key) VALUES (?,?,?)", act)
        self.disk.execute("COMMIT")
        return record

    def tick(self) -> None:
        """Begin what is queued and end what has worked for long enough."""
        for goal_id, state in self.disk.execute("SELECT id, state FROM goals").fetchall():
            if state in ENDED or self.is_stopped:
                continue
            if state == "queued":
                self.since[goal_id] = time.monotonic()
                if self.rules["ask"]:
                    words = {"en": self.rules["question"], "zh": "哪扇门？"}
                    plan = {"kind": "clarify", "text": words}
                    self.move(goal_id, "needs_clarification", plan=plan)
                else:
                    self.move(goal_id, "running")
            elif state == "running":
                began = self.since.setdefault(goal_id, time.monotonic())
                if time.monotonic() - began >= self.rules["work_s"]:
                    self.move(goal_id, "succeeded")
            elif state == "paused" and self.rules["resume"]:
                self.move(goal_id, "running", answered=True)

    def changes(self, after: int, limit: int) -> dict[str, Any]:
        rows = self.disk.execute(
            "SELECT goal, MAX(seq) AS s FROM changes WHERE seq>? GROUP BY goal ORDER BY s LIMIT ?",
            (after, limit),
        ).fetchall()
        return {
            "goals": [self.goal(row[0]) for row in rows],
            "next": rows[-1][1] if rows else after,
        }

    def stop(self) -> dict[str, Any]:
        """Pause what runs."""
        self.disk.execute("INSERT INTO acts (act) VALUES ('stop')")
        for goal_id, state in self.disk.execute("SELECT id, state FROM goals").fetchall():
            if state not in ENDED:
                self.move(goal_id, "paused", reason="stop")
        return {"accepted": True}


def outcome(state: str) -> dict[str, Any]:
    return {"code": state, "message": {"en": f"It is {state}.", "zh": f"结果：{state}。"}}


def problem(code: str) -> dict[str, Any]:
    return {"code": code, "detail": code, "message": {"en": code, "zh": code}}


class Door(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    journal: Journal
    authority = b""
    timeout = 5.0

    def log_message(self, format: str, *args: Any) -> None:  # noqa: A002  # the library's name
        pass

    def do_GET(self) -> None:
        if self.path == "/ca.crt" and self.authority:
            self.send_response(200)
            self.send_header("content-length", str(len(self.authority)))
            self.end_headers()
            self.wfile.write(self.authority)
            return
        self._serve(None)

    def do_POST(self) -> None:
        length = int(self.headers.get("content-length", 0))
        self._serve(json.loads(self.rfile.read(length) or b"{}"))

    def _serve(self, body: dict[str, Any] | None) -> None:
        parts = urlsplit(self.path)
        with self.journal.lock:
            rules = self.journal.rules
            if parts.path == "/stub":
                rules.update(body or {})
                return self._answer(200, rules)
            wanted = f"Bearer {rules['token']}"
            if rules["token"] and self.headers.get("authorization") != wanted:
                return self._answer(401, problem("token_needed"))
            status, content = self._act(parts.path, parse_qs(parts.query), body)
            is_lost = body is not None and parts.path == "/v1/goals" and rules["lose_answers"] > 0
            if is_lost:  # it is on disk, and nobody hears of it
                rules["lose_answers"] -= 1
                self.close_connection = True
                return None
        if rules["evil"]:
            return self._answer_evil(rules["evil"], parts.path, content)
        return self._answer(status, content)

    def _answer_evil(self, how: str, path: str, content: dict[str, Any]) -> None:
        """Answer as a robot that was taken over, or as what is no robot at all."""
        changes, never = path == "/v1/goals" and "goals" in content, {"x": [float("nan")]}
        if how == "never":
            time.sleep(600.0)
        if how in ("endless", "slow"):
            self.send_response(200)
            self.send_header("transfer-encoding", "chunked")
            self.end_headers()
            piece = b"10000\r\n" + b" " * 65_536 if how == "endless" else b"1\r\n "
            while True:
                self.wfile.write(piece + b"\r\n")
                time.sleep(0.0 if how == "endless" else 0.5)
        if how == "html":
            self.send_response(200)
            self.end_headers()
            self.wfile.write(b"<html>" + b"x" * 5_000_000)
            self.close_connection = True
            return None
        if how == "cursor" and changes:
            content["next"] = "abc"
        elif how == "pages" and changes:
            record = {"id": "another's", "state": "succeeded"}
            content = {"goals": [record] * 30, "next": 2**40}
        elif how == "goals" and path.startswith("/v1/goals"):
            content = {**content, "id": 7, "state": never, "goals": [never], "next": -1}
        elif how == "status" and path == "/v1/robot":
            content = {"status": "fine", "room": never}
        elif how == "another":
            content = {**content, "robot_id": "honest0"}
        return self._answer(200, content)

    def _act(
        self, path: str, query: dict[str, list[str]], body: dict[str, Any] | None
    ) -> tuple[int, dict[str, Any]]:
        journal, rules = self.journal, self.journal.rules
        words = path.strip("/").split("/")
        if body is None:
            return self._show(words, query)
        match words:
            case ["v1", "goals"]:
                if rules["refuse"] and "points" not in body:
                    return rules["refuse"], problem("refused_by_rule")
                return journal.give(body, self.headers.get("idempotency-key"))
            case ["v1", "goals", goal_id, "cancel"]:
                if journal.goal(goal_id).get("state") in ENDED:
                    return 409, problem("bad_state")
                return 200, journal.move(goal_id, "cancelled")
            case ["v1", "goals", goal_id, "pause"]:
                return 200, journal.move(goal_id, "paused")
            case ["v1", "goals", goal_id, "resume"]:
                if rules["proof"]:
                    return 403, problem("operator_proof_needed")
                journal.is_stopped = False
                return 200, journal.move(goal_id, "running", answered=True)
            case ["v1", "goals", goal_id, "answer"]:
                return 200, journal.move(goal_id, "running", plan=None)
            case ["v1", "stop"]:
                return 200, journal.stop()
            case ["v1", "rehearsals"]:
                step = {"does": rules["does"], "points": rules["through"]}
                return 200, {"steps": [step], "length_m": rules["length_m"]}
        return 404, problem("unknown_route")

    def _show(self, words: list[str], query: dict[str, list[str]]) -> tuple[int, dict[str, Any]]:
        journal, rules = self.journal, self.journal.rules
        match words:
            case ["v1", "capabilities"]:
                places = [{"id": name, "name": {"en": name}, "pose": {"x_m": 1.0, "y_m": 0.0},
                           "polygon": OUTLINES.get(name)} for name in rules["places"]]  # fmt: skip
                told = ("site", "map_id", "camera", "languages")
                return 200, {"robot_id": rules["id"], "release": "0.1", "places": places,
                             **{name: rules[name] for name in told}, **rules["card"]}  # fmt: skip
            case ["v1", "orders"]:
                return 200, {"orders": rules["orders"]}
            case ["v1", "usage"]:
                today = {"calls": 1, "money": rules["money"]}
                now = time.time() + rules["clock_s"]
                return 200, {"model": rules["model"], "currency": "USD", "today": today,
                             "day": time.strftime("%Y-%m-%d", time.gmtime(now))}  # fmt: skip
            case ["v1", "people"]:
                return 200, {"you": {"id": "fleet", "role": rules["role"]}}
            case ["v1", "robot"]:
                status = {"mode": "ACTIVE", "drive": {"battery": rules["battery"]},
                          "base_in_map": {"x_m": 1.0, "y_m": 1.0, "yaw_rad": 0.5}}  # fmt: skip
                return 200, {"status": rules["status"] or status, "room": rules["room"],
                             "map_id": rules["map_id"]}  # fmt: skip
            case ["v1", "map"]:
                return 200, MAPS[rules["map"]]
            case ["v1", "goals"]:
                after, limit = int(query.get("after", ["0"])[0]), int(query["limit"][0])
                return 200, journal.changes(after, limit)
            case ["v1", "goals", goal_id]:
                found = journal.goal(goal_id)
                return (200, found) if found else (404, problem("unknown_goal"))
        return 404, problem("unknown_route")

    def _answer(self, status: int, content: dict[str, Any]) -> None:
        if content is MAPS["endless"]:
            self._answer_endlessly()
            return
        raw = json.dumps(content).encode()
        self.send_response(status)
        self.send_header("content-type", "application/json")
        self.send_header("content-length", str(len(raw)))
        self.end_headers()
        self.wfile.write(raw)

    def _answer_endlessly(self) -> None:
        self.send_response(200)
        self.send_header("content-length", str(100_000_000))
        self.end_headers()
        try:
            for _ in range(100):
                self.wfile.write(b"[" * 1_000_000)
        except OSError:
            self.close_connection = True


class Server(ThreadingHTTPServer):
    """A robot's door, and the thread that lives its journal until the door is closed."""

    daemon_threads = True

    def __init__(self, *given: Any) -> None:
        self._closed = threading.Event()
        super().__init__(*given)

    def live(self, journal: Journal) -> None:
        def tick() -> None:
            while not self._closed.wait(0.02):
                with journal.lock:
                    journal.tick()

        threading.Thread(target=tick, daemon=True).start()

    def server_close(self) -> None:
        super().server_close()
        self._closed.set()

    def handle_error(self, request: Any, client_address: Any) -> None:
        pass


def make_server(
    folder: Path, name: str, port: int, tls: ssl.SSLContext | None = None, authority: bytes = b"",
    host: str = "127.0.0.1",
) -> Server:  # fmt: skip
    """Return a robot's server, its journal taken up."""
    journal = Journal(folder, name)
    server = Server(
        (host, port), type("OwnDoor", (Door,), {"journal": journal, "authority": authority})
    )
    if tls is not None:
        server.socket = tls.wrap_socket(server.socket, server_side=True)

    server.live(journal)
    return server


def main() -> None:
    folder, name, port = Path(sys.argv[1]), sys.argv[2], int(sys.argv[3])
    host, tls = "127.0.0.1", None
    if len(sys.argv) > 4:
        host, tls = sys.argv[4], ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        tls.load_cert_chain(sys.argv[5])
    server = make_server(folder, name, port, tls, host=host)
    print(server.server_address[1], flush=True)
    parent = os.getppid()

    def end_with_parent() -> None:
        while os.getppid() == parent:
            time.sleep(0.5)
        os._exit(0)

    threading.Thread(target=end_with_parent, daemon=True).start()
    server.serve_forever()


if __name__ == "__main__":
    main()
