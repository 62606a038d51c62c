/** Hold the theme: light, dark, or as the person's system is. The page's one reader of the system's. */
import { computed, effect, signal } from "@preact/signals";

const SLOT = "pons.theme";

export const THEMES = ["system", "light", "dark"] as const;
export type Theme = (typeof THEMES)[number];

export const theme = signal<Theme>("system");
const systemIsDark = signal(false);

/** Whether the page is dark now. */
export const isDark = computed(() =>
  theme.value === "system" ? systemIsDark.value : theme.value === "dark",
);

export function startTheme(): void {
  const system = matchMedia("(prefers-color-scheme: dark)");
  systemIsDark.value = system.matches;
  system.addEventListener("change", (event) => (systemIsDark.value = event.matches));
  theme.value = THEMES.find((known) => known === localStorage.getItem(SLOT)) ?? "system";
  effect(() => {
    const root = document.documentElement;
    root.dataset.theme = root.style.colorScheme = isDark.value ? "dark" : "light";
  });
}

export function chooseTheme(wanted: Theme): void {
  theme.value = wanted;
  localStorage.setItem(SLOT, wanted);
}
