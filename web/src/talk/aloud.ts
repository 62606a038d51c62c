/**
 * Read aloud, by the browser's own voices, what the robot says and asks and how goals end. A person
 * switches it on; stop, talking and a new order break it off.
 */
import { effect, signal } from "@preact/signals";
import { goals, spoken } from "../state/store";
import type { Goal, Language } from "../wire/types";

const SLOT = "pons.aloud";
const MOST_WAITING = 4; // what comes later than that misleads
const VOICES: Record<Language, string> = { en: "en-US", zh: "zh-CN" };

/** Whether answers are read aloud on this device. */
export const aloud = signal(false);

export const canSpeak = (): boolean =>
  "speechSynthesis" in globalThis && "SpeechSynthesisUtterance" in globalThis;

let waiting = 0;

export function setAloud(on: boolean): void {
  aloud.value = on && canSpeak();
  localStorage.setItem(SLOT, aloud.value ? "1" : "0");
  if (!aloud.value) hush();
}

/** Break off at once. Never throws: Stop calls it. */
export function hush(): void {
  waiting = 0;
  if (canSpeak()) speechSynthesis.cancel();
}

export function readAloud(text: string, language: Language): void {
  if (!aloud.peek() || text === "" || waiting >= MOST_WAITING) return;
  const utterance = new SpeechSynthesisUtterance(text);
  utterance.lang = VOICES[language];
  const gone = (): void => {
    waiting = Math.max(0, waiting - 1);
  };
  utterance.onend = gone;
  utterance.onerror = gone;
  waiting += 1;
  speechSynthesis.speak(utterance);
}

/** Return what is said of a goal's new state, in the goal's own language; null for nothing. */
export function wordsOf(goal: Goal): string | null {
  const language: Language = goal.language === "zh" ? "zh" : "en";
  if (goal.outcome) return goal.outcome.message[language];
  const asks = goal.state === "needs_clarification" || goal.state === "awaiting_confirmation";
  return asks && goal.plan?.text ? goal.plan.text[language] : null;
}

export function startAloud(): void {
  aloud.value = canSpeak() && localStorage.getItem(SLOT) === "1";
  let newest = spoken.peek();
  let known: ReadonlyMap<string, string> | null = null;
  effect(() => {
    const words = spoken.value;
    if (words !== null && words !== newest) readAloud(words.text, words.language);
    newest = words;
  });
  effect(() => {
    const states = new Map(goals.value.map((goal) => [goal.id, goal.state]));
    for (const goal of goals.value) {
      if (known === null || known.get(goal.id) === goal.state) continue;
      const words = wordsOf(goal);
      if (words !== null && words !== newest?.text)
        readAloud(words, goal.language === "zh" ? "zh" : "en");
    }
    if (states.size > 0 || known !== null) known = states;
  });
}
