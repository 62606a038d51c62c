/** Offer the answers to a question: its options, a yes or no to a plan, and a person's own words. */
import { useSignal } from "@preact/signals";
import { say, t } from "../i18n";
import type { Bilingual } from "../wire/types";

const MANY_CHARACTERS = 100;

export type Option = { readonly text: string; readonly label: Bilingual };

export function QuestionForm(asked: {
  words: string;
  options: readonly Option[];
  /** Given where the question is whether to do a plan. */
  confirm: { readonly yes: () => void; readonly no: () => void } | null;
  /** Send an answer; true: it was taken. */
  send: (text: string) => Promise<boolean>;
}) {
  const reply = useSignal("");
  const send = async (text: string): Promise<void> => {
    if (await asked.send(text)) reply.value = "";
  };
  return (
    <div class="clarify">
      <p
        class="question-words"
        dir="auto"
        tabIndex={asked.words.length > MANY_CHARACTERS ? 0 : undefined} // it may have to be scrolled
      >
        {asked.words}
      </p>
      <div class="buttons">
        {asked.confirm && (
          <>
            <button type="button" class="main" onClick={asked.confirm.yes}>
              {t("goal.confirm")}
            </button>
            <button type="button" onClick={asked.confirm.no}>
              {t("said.no")}
            </button>
          </>
        )}
        {asked.options.map((option) => (
          <button
            key={option.text}
            type="button"
            class="clip"
            onClick={() => void send(option.text)}
          >
            {say(option.label)}
          </button>
        ))}
      </div>
      <form
        class="goal-row"
        onSubmit={(event) => {
          event.preventDefault();
          const text = reply.value.trim();
          if (text) void send(text);
        }}
      >
        <input
          type="text"
          autocomplete="off"
          enterkeyhint="send"
          aria-label={t("goal.reply")}
          placeholder={t("goal.reply")}
          value={reply.value}
          onInput={(event) => (reply.value = event.currentTarget.value)}
        />
        <button type="submit" disabled={reply.value.trim() === ""}>
          {t("goal.reply.send")}
        </button>
      </form>
    </div>
  );
}
