/** Hold what is told a person for a while, and the words of a failed request. */
import { signal } from "@preact/signals";
import { causeWords, say, t, wantWords, word } from "../i18n";
import { ApiError } from "../net/api";

export type Note = { readonly id: number; readonly text: string; readonly bad: boolean };

/** What was told last; shown for a while and read aloud. */
export const note = signal<Note | null>(null);

export function tell(text: string, bad = false): void {
  note.value = { id: (note.peek()?.id ?? 0) + 1, text, bad };
}

export function explain(error: unknown): string {
  if (!(error instanceof ApiError)) return String(error);
  if (error.words) return say(error.words);
  const known = word("error", error.code);
  if (known !== error.code) return known;
  const want = wantWords(error.code);
  if (want) return t("notice.waiting", { what: want });
  const cause = causeWords(error.code);
  if (cause) return cause;
  return t("error.other", { code: error.code, detail: error.detail });
}
