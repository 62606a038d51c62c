/**
 * Let the planner hear a recording while it is being spoken, for a stop alone. Whatever fails here,
 * the recording itself goes on and is heard whole at its end.
 */
import { dial } from "../net/socket";
import samples from "./samples.worklet.js?url&no-inline";

const MOST_WAITING = 100; // frames of 43 ms until the socket is open

export type Live = { readonly end: () => void };

/** Begin; `stopped` is called once the robot was told to stop. Never throws. */
export function listenLive(stream: MediaStream, stopped: () => void): Live {
  const ends: (() => void)[] = [];
  const end = (): void => {
    for (const one of ends.splice(0)) one();
  };
  begin(stream, stopped, ends).catch(end); // no worklet, no socket: nothing is heard early
  return { end };
}

async function begin(
  stream: MediaStream,
  stopped: () => void,
  ends: (() => void)[],
): Promise<void> {
  const context = new AudioContext();
  ends.push(() => void context.close().catch(() => undefined));
  const socket = open(context.sampleRate, stopped);
  ends.push(() => socket.end());
  await context.audioWorklet.addModule(samples);
  const source = context.createMediaStreamSource(stream);
  const worklet = new AudioWorkletNode(context, "samples", { numberOfOutputs: 0 });
  worklet.port.onmessage = (event: MessageEvent<ArrayBuffer>) => socket.send(event.data);
  source.connect(worklet);
}

function open(
  rateHz: number,
  stopped: () => void,
): { send: (frame: ArrayBuffer) => void; end: () => void } {
  const socket = dial("v1/voice/live");
  const waiting: ArrayBuffer[] = [];
  socket.onopen = () => {
    socket.send(JSON.stringify({ rate_hz: rateHz }));
    for (const frame of waiting.splice(0)) socket.send(frame);
  };
  socket.onmessage = (message) => {
    if (saysStopped(message.data)) stopped();
  };
  const send = (frame: ArrayBuffer): void => {
    if (socket.readyState === WebSocket.OPEN) socket.send(frame);
    else if (socket.readyState === WebSocket.CONNECTING && waiting.length < MOST_WAITING)
      waiting.push(frame);
  };
  const end = (): void => {
    if (socket.readyState === WebSocket.OPEN) socket.send('{"end":true}');
    else socket.close();
  };
  return { send, end };
}

/** Return whether a message of the planner says that a stop was heard and obeyed. */
export function saysStopped(data: unknown): boolean {
  if (typeof data !== "string") return false;
  try {
    const told: unknown = JSON.parse(data);
    return typeof told === "object" && told !== null && "type" in told && told.type === "stopped";
  } catch {
    return false;
  }
}
