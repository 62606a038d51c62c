/** Say an entry of the log in a sentence; what has none keeps its code. */
import { causeWords, rowWords, say, t, word } from "../i18n";
import type { LogEntry } from "../state/model";

export type Told = { readonly text: string; readonly fine: string };

export function told(entry: LogEntry): Told {
  if (entry.words) return { text: say(entry.words), fine: "" };
  if (entry.kind === "say") return { text: `${t("log.say")}: ${entry.text}`, fine: "" };
  if (entry.kind === "act") return { text: t("log.act", { code: entry.code }), fine: "" };
  if (entry.kind === "planner") return { text: entry.text, fine: entry.code };
  return fromBridge(entry.code, entry.text);
}

function fromBridge(code: string, detail: string): Told {
  const [first = "", second = ""] = detail.split(" ");
  const [row = ""] = first.split("."); // a row's stage stands behind its name
  switch (code) {
    case "row_up":
      return { text: rowWords(row), fine: detail };
    case "row_down":
      return { text: t("event.row_down", { what: rowWords(row) }), fine: detail };
    case "mode": {
      const names = { from: word("mode", first), to: word("mode", second) };
      const fine = detail.split(" ").slice(2).join(" ");
      const why = causeWords(fine);
      const text = why ? t("event.mode_why", { ...names, why }) : t("event.mode", names);
      return { text, fine };
    }
    case "blocked": // by fence, asked 0.40 m/s
      return { text: causeWords(second.replace(",", "")) ?? t("event.blocked"), fine: detail };
    case "stop_failed":
      return { text: causeWords(first) ?? t("event.stop_failed"), fine: detail };
    case "hello_refused":
      return {
        text: [t("event.hello_refused"), causeWords(second) ?? ""].join(" ").trim(),
        fine: detail,
      };
    case "held":
      return { text: word("held", first), fine: "" };
    default: {
      const known = word("event", code);
      return known === code ? { text: code, fine: detail } : { text: known, fine: detail };
    }
  }
}
