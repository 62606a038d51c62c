/**
 * Bring the hand's state machine to a browser: one socket, one clock, and every way in which a page
 * may stop to be somebody's who holds a stick. Runs only while the panel is open.
 */
import { effect, signal } from "@preact/signals";
import { waitMs } from "../net/backoff";
import { dial } from "../net/socket";
import { stopState } from "../stop/stopper";
import { readPad } from "./inputs";
import { advance, AT_REST, FRAME_MS, type HandEvent, type HandState, type Why } from "./machine";

export type Driver = { readonly id: string; readonly name: string };

export const hand = signal<HandState>(AT_REST);
export const padName = signal<string | null>(null);
/** Which share of the robot's limits the whole way of the stick asks for. */
export const share = signal(0.4);

const SLOT = "pons.name";
/** By which the robot knows this page's hand. */
export const ownId = signal<string | null>(null);
export const ownName = signal("");

let socket: WebSocket | null = null;
let tries = 0;
let redial: ReturnType<typeof setTimeout> | undefined;
let ends: (() => void)[] = [];

/** Take one event; what it makes the stick say is sent at once. */
export function take(event: HandEvent): void {
  const step = advance(hand.peek(), event, performance.now());
  hand.value = step.state;
  if (step.frame === null || socket?.readyState !== WebSocket.OPEN) return;
  const { forward, left, ...frame } = step.frame;
  const scaled = { ...frame, forward: forward * share.peek(), left: left * share.peek() };
  try {
    socket.send(JSON.stringify(scaled));
  } catch {
    socket.close(); // what cannot be told is ended by silence
  }
}

export const drop = (why: Why): void => take({ type: "drop", why });

export function callMyself(name: string): void {
  ownName.value = name.slice(0, 40);
  localStorage.setItem(SLOT, ownName.value);
  sayName();
}

function sayName(): void {
  if (socket?.readyState === WebSocket.OPEN) socket.send(JSON.stringify({ name: ownName.peek() }));
}

/** Begin: dial, and listen to all that ends a hold. Returns what ends it. */
export function openStick(): () => void {
  ownName.value = localStorage.getItem(SLOT) ?? "";
  const on = (target: EventTarget, kind: string, act: () => void): void => {
    target.addEventListener(kind, act);
    ends.push(() => target.removeEventListener(kind, act));
  };
  on(window, "blur", () => drop("blur"));
  on(window, "pagehide", hide);
  on(document, "freeze", hide);
  on(document, "visibilitychange", () =>
    document.visibilityState === "visible" ? connect() : hide(),
  );
  on(window, "online", connect);
  on(window, "gamepaddisconnected", () => take({ type: "pad_gone" }));
  const clock = setInterval(pulse, FRAME_MS);
  ends.push(() => clearInterval(clock));
  ends.push(
    effect(() => {
      if (stopState.value.phase === "asking") drop("stopped");
    }),
  );
  connect();
  return close;
}

function close(): void {
  drop("hidden");
  for (const end of ends) end();
  ends = [];
  hangUp();
  hand.value = AT_REST;
}

/** Nobody sees the page: let go, and be no page with a stick until somebody does. */
function hide(): void {
  drop("hidden");
  hangUp();
}

function hangUp(): void {
  clearTimeout(redial);
  const gone = socket;
  socket = null;
  gone?.close();
  if (gone) take({ type: "closed" });
}

function connect(): void {
  clearTimeout(redial);
  if (socket !== null || document.visibilityState !== "visible") return;
  const made = dial("v1/hand");
  socket = made;
  made.onopen = () => {
    tries = 0;
    take({ type: "opened" });
    sayName();
  };
  made.onmessage = (message) => hear(message.data);
  made.onclose = () => {
    if (socket !== made) return;
    socket = null;
    take({ type: "closed" });
    redial = setTimeout(connect, waitMs(tries, Math.random()));
    tries += 1;
  };
}

type Beat = { readonly kind?: unknown; readonly beat?: unknown; readonly [key: string]: unknown };

function hear(data: unknown): void {
  const said = parsed(data);
  if (said?.kind !== "beat" || typeof said.beat !== "number") return;
  if (typeof said.id === "string") ownId.value = said.id;
  const driver = said.driver as Driver | null;
  const by = driver === null ? null : driver.id === said.id ? "me" : "other";
  take({ type: "beat", beat: said.beat, by, code: (said.code as Why | null) ?? null });
}

function parsed(data: unknown): Beat | null {
  try {
    return typeof data === "string" ? (JSON.parse(data) as Beat | null) : null;
  } catch {
    return null;
  }
}

function pulse(): void {
  take({ type: "tick" });
  const pad = navigator.getGamepads?.().find((one) => one?.connected) ?? null;
  if (padName.peek() !== (pad?.id ?? null)) {
    padName.value = pad?.id ?? null;
    take({ type: "pad_gone" }); // another one must be seen neutral too
  }
  if (pad) take({ type: "pad", ...readPad(pad) });
}
