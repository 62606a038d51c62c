/** Let a person choose how this page looks here; other pages are as they were. */
import { t } from "../i18n";
import { chooseTheme, theme, THEMES } from "../state/theme";

export function ThemePanel() {
  return (
    <section class="card" id="theme" aria-labelledby="theme-title">
      <h2 id="theme-title">{t("theme.title")}</h2>
      <div class="languages" role="group" aria-labelledby="theme-title">
        {THEMES.map((known) => (
          <button
            key={known}
            type="button"
            aria-pressed={theme.value === known}
            onClick={() => chooseTheme(known)}
          >
            {t(`theme.${known}`)}
          </button>
        ))}
      </div>
    </section>
  );
}
