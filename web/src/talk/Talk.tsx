/** Hold to talk: a recorded order becomes a goal as a typed one does. Says why where it can't. */
import { signal } from "@preact/signals";
import { useRef } from "preact/hooks";
import { say, t } from "../i18n";
import { giveSpoken, hushRobot, type Voice } from "../net/api";
import { explain, tell } from "../state/note";
import { learn } from "../state/store";
import { aloud, canSpeak, hush, setAloud } from "./aloud";
import { CannotListen, deaf, record, type Recording } from "./recorder";

type Phase = "idle" | "listening" | "hearing";

/** What this robot hears; null until it told. */
export const voice = signal<Voice | null>(null);
const phase = signal<Phase>("idle");
const LEAST_MS = 300; // a tap is no order

export function Talk() {
  const recording = useRef<Promise<Recording> | null>(null);
  const beganMs = useRef(0);
  const why = deaf();
  const begin = (): void => {
    if (phase.value !== "idle") return;
    phase.value = "listening";
    hush();
    hushRobot().catch(() => undefined); // it may be mute, or gone; the recording tells
    beganMs.current = performance.now();
    recording.current = record(() => {
      hush();
      tell(t("talk.stopped"), true);
    });
    recording.current.catch((error: unknown) => {
      phase.value = "idle";
      tell(words(error), true);
    });
  };
  const end = async (): Promise<void> => {
    const running = recording.current;
    if (phase.value !== "listening" || running === null) return;
    recording.current = null;
    phase.value = "hearing";
    try {
      const recorded = await running;
      const sound = await recorded.end();
      if (performance.now() - beganMs.current < LEAST_MS) tell(t("talk.short"));
      else await send(sound, recorded.stopped());
    } catch (error) {
      tell(words(error), true);
    } finally {
      phase.value = "idle";
    }
  };
  if (why !== null)
    return (
      <p class="fine" id="talk-why">
        {t(`talk.${why}`)}
      </p>
    );
  return (
    <div class="talk">
      <button
        type="button"
        id="talk"
        class={phase.value}
        disabled={phase.value === "hearing"}
        aria-pressed={phase.value === "listening"}
        onPointerDown={(event) => {
          if (event.button !== 0) return;
          event.currentTarget.setPointerCapture(event.pointerId); // a finger may slip off it
          begin();
        }}
        onPointerUp={() => void end()}
        onPointerCancel={() => void end()}
        onClick={(event) => {
          if (event.detail !== 0) return; // by Enter: once to begin, once to end
          if (phase.value === "idle") begin();
          else void end();
        }}
        onContextMenu={(event) => event.preventDefault()} // a long touch is talking, no menu
      >
        <Microphone />
        {t(`talk.${phase.value}`)}
      </button>
      <span class="fine" id="talk-hears">
        {hears()}
      </span>
    </div>
  );
}

/** Say which languages are heard, and where the sound goes if it leaves the robot. */
function hears(): string {
  const told = voice.value;
  const both = told?.languages.includes("zh") ?? false;
  const words = t(both ? "talk.both" : "talk.english");
  return told?.host ? `${words} · ${t("talk.goes", { host: told.host })}` : words;
}

/** Switch on that answers are read aloud on this device; nothing where the browser has no voice. */
export function Aloud() {
  if (!canSpeak()) return null;
  return (
    <label class="aloud fine">
      <input
        type="checkbox"
        id="aloud"
        checked={aloud.value}
        onChange={(event) => setAloud(event.currentTarget.checked)}
      />
      {t("talk.aloud")}
    </label>
  );
}

function Microphone() {
  return (
    <svg class="microphone" viewBox="0 0 16 16" aria-hidden="true">
      <rect x="5.5" y="1" width="5" height="9" rx="2.5" fill="currentColor" />
      <path d="M3 7.5a5 5 0 0 0 10 0M8 12.5V15" fill="none" stroke="currentColor" />
    </svg>
  );
}

/** After a stop in it, whatever else it says waits for a yes. */
async function send(sound: ArrayBuffer, stopped: boolean): Promise<void> {
  const spoken = await giveSpoken(sound, stopped);
  if (spoken.goal) {
    learn(spoken.goal);
    if (spoken.trouble) tell(t("talk.instead", { text: spoken.goal.text }));
  } else if (spoken.message) {
    tell(say(spoken.message));
  }
}

const words = (error: unknown): string =>
  error instanceof CannotListen ? t(`talk.${error.why}`) : explain(error);
