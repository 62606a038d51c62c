/**
 * Record while a person talks, and return it as WAV. The microphone is opened when they begin and
 * let go when they end; nothing is kept.
 */
import { listenLive } from "./live";
import { RATE_HZ, wav } from "./wav";

export const LONGEST_MS = 14_000; // the planner takes 15 s

/** Why this page can't listen; each has a sentence. */
export type Deaf = "insecure" | "unsupported" | "refused" | "no_microphone" | "unreadable";

export class CannotListen extends Error {
  constructor(readonly why: Deaf) {
    super(why);
  }
}

/** Say why this browser can't record here at all; null where it can. */
export function deaf(): Deaf | null {
  if (!window.isSecureContext) return "insecure";
  const there = "mediaDevices" in navigator && "MediaRecorder" in window;
  return there && "OfflineAudioContext" in window ? null : "unsupported";
}

export type Recording = {
  readonly end: () => Promise<ArrayBuffer>;
  /** Whether a stop was heard in it, and obeyed, before its end. */
  readonly stopped: () => boolean;
};

/** Begin to record; `onStop` is called where a stop is heard meanwhile. Throws CannotListen. */
export async function record(onStop: () => void): Promise<Recording> {
  const stream = await microphone();
  let heardStop = false;
  const live = listenLive(stream, () => {
    heardStop = true;
    onStop();
  });
  const recorder = new MediaRecorder(stream);
  const parts: Blob[] = [];
  recorder.ondataavailable = (event) => parts.push(event.data);
  const ended = new Promise<void>((done) => {
    recorder.onstop = () => done();
  });
  recorder.start();
  const stop = (): void => {
    if (recorder.state !== "inactive") recorder.stop();
  };
  const limit = setTimeout(stop, LONGEST_MS);
  const end = async (): Promise<ArrayBuffer> => {
    clearTimeout(limit);
    live.end();
    stop();
    await ended;
    for (const track of stream.getTracks()) track.stop();
    return wav(await samples(await new Blob(parts).arrayBuffer()));
  };
  return { end, stopped: () => heardStop };
}

async function microphone(): Promise<MediaStream> {
  try {
    return await navigator.mediaDevices.getUserMedia({ audio: { channelCount: 1 } });
  } catch (error) {
    const name = error instanceof DOMException ? error.name : "";
    throw new CannotListen(name === "NotFoundError" ? "no_microphone" : "refused");
  }
}

/** Return what was recorded as one channel at RATE_HZ, whatever the browser recorded it as. */
async function samples(recorded: ArrayBuffer): Promise<Float32Array> {
  try {
    const shape = new OfflineAudioContext(1, 1, RATE_HZ);
    const sound = await shape.decodeAudioData(recorded); // resampled to the context's rate
    const mixed = new OfflineAudioContext(1, Math.max(1, sound.length), RATE_HZ);
    const source = mixed.createBufferSource();
    source.buffer = sound;
    source.connect(mixed.destination);
    source.start();
    return (await mixed.startRendering()).getChannelData(0);
  } catch {
    throw new CannotListen("unreadable");
  }
}
