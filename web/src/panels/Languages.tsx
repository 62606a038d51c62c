/** Let a person choose the language. */
import { choose, language, t } from "../i18n";

export function Languages() {
  return (
    <fieldset class="languages">
      <legend class="unseen">{t("page.language")}</legend>
      {(["en", "zh"] as const).map((code) => (
        <button
          key={code}
          type="button"
          lang={code === "zh" ? "zh-CN" : "en"}
          aria-pressed={language.value === code}
          onClick={() => choose(code)}
        >
          {code === "zh" ? "中文" : "EN"}
        </button>
      ))}
    </fieldset>
  );
}
