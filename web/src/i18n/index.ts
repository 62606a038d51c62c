/** Say everything in the person's language. The only door to the catalogues. */
import { effect, signal } from "@preact/signals";
import type { Bilingual, Language } from "../wire/types";
import codes from "./codes.json";
import { en, type Key } from "./en";
import rows from "./rows.json";
import { zh } from "./zh";

const SLOT = "pons.language";
const CATALOGUES: Record<Language, Record<Key, string>> = { en, zh };

export const language = signal<Language>("en");

/** Begin in the person's language; `title` names the page. */
export function startLanguage(title: () => string = () => t("page.title")): void {
  const kept = localStorage.getItem(SLOT);
  const wanted = kept ?? navigator.language;
  language.value = wanted.toLowerCase().startsWith("zh") ? "zh" : "en";
  effect(() => {
    document.documentElement.lang = language.value === "zh" ? "zh-CN" : "en";
    document.title = title();
  });
}

export function choose(wanted: Language): void {
  language.value = wanted;
  localStorage.setItem(SLOT, wanted);
}

/** Return a sentence with its blanks filled. */
export function t(key: Key, facts: Readonly<Record<string, string>> = {}): string {
  const sentence: string = CATALOGUES[language.value][key];
  return sentence.replace(/\{(\w+)\}/g, (blank, name: string) => facts[name] ?? blank);
}

/** Say whether a code from outside has a sentence here, which may be the code itself. */
export const hasWord = (family: string, code: string): boolean =>
  Object.hasOwn(en, `${family}.${code}`);

/** Return the sentence of a code from outside, or the code itself where there is none. */
export const word = (family: string, code: string): string =>
  hasWord(family, code) ? t(`${family}.${code}` as Key) : code;

/** Name a door or a person by whom something was done. */
export const byWhom = (who: string): string =>
  hasWord("by_whom", who) ? word("by_whom", who) : t("by_someone", { who });

export const say = (words: Bilingual): string => words[language.value];

type Words = Readonly<Record<string, Bilingual>>;
const ROWS: Words = rows;
const SENTENCES: Words = codes.sentences;
const WANTS: Words = codes.wants;
const TRIAL: Words = codes.trial;

/** Name a step of a trial. */
export function stepWords(step: string): string {
  const known = TRIAL[step];
  return known ? say(known) : step;
}

/** Return the bridge's own sentence for a row. */
export function rowWords(row: string): string {
  const known = ROWS[row];
  return known ? say(known) : row;
}

/** Return the sentence of a stop's cause, a fault or a refusal, which may be a row; null: none. */
export function causeWords(code: string): string | null {
  const known = ROWS[code.toUpperCase()] ?? SENTENCES[code];
  return known ? say(known) : null;
}

/** Name what is waited for, to stand in a list; null: it has no name there. */
export function wantWords(code: string): string | null {
  const known = WANTS[code];
  return known ? say(known) : null;
}

export type { Key };
