import { beforeEach, expect, test, vi } from "vitest";

const listeners: ((event: { matches: boolean }) => void)[] = [];
const kept = new Map<string, string>();
const root = { dataset: {} as Record<string, string>, style: {} as Record<string, string> };

beforeEach(() => {
  vi.resetModules();
  kept.clear();
  listeners.length = 0;
  vi.stubGlobal("localStorage", {
    getItem: (key: string) => kept.get(key) ?? null,
    setItem: (key: string, value: string) => kept.set(key, value),
  });
  vi.stubGlobal("matchMedia", () => ({
    matches: true,
    addEventListener: (_: string, listener: (typeof listeners)[number]) => listeners.push(listener),
  }));
  vi.stubGlobal("document", { documentElement: root });
});

test("the page is as the system until a person chooses, and then whatever the system does", async () => {
  const { chooseTheme, startTheme } = await import("../src/state/theme");
  startTheme();
  expect(root.dataset.theme).toBe("dark");
  listeners.forEach((tell) => tell({ matches: false }));
  expect(root.dataset.theme).toBe("light");
  chooseTheme("dark");
  listeners.forEach((tell) => tell({ matches: false }));
  expect([root.dataset.theme, root.style.colorScheme]).toEqual(["dark", "dark"]);
  chooseTheme("system");
  expect(root.dataset.theme).toBe("light");
});

test("what was chosen is kept, and what is kept and unknown is as the system", async () => {
  kept.set("pons.theme", "light");
  const first = await import("../src/state/theme");
  first.startTheme();
  expect(root.dataset.theme).toBe("light");
  vi.resetModules();
  kept.set("pons.theme", "purple");
  const second = await import("../src/state/theme");
  second.startTheme();
  expect([second.theme.value, root.dataset.theme]).toEqual(["system", "dark"]);
});
