// Build the pages into dist/, every file but index.html and fleet.html named by its hash. Asks nobody
// outside. `--mode fleet` adds the fleet's page to a built robot's page, and shares no chunk with it: the
// robot's page comes in one file as before.
import { defineConfig } from "vite";

declare const process: { readonly env: Record<string, string | undefined> };
const planner = process.env.PONS_URL ?? "http://127.0.0.1:8420";

export default defineConfig(({ mode }) => ({
  base: "./", // a proxy may serve the page below a path of its own
  build: {
    target: "es2022",
    modulePreload: { polyfill: false },
    assetsInlineLimit: 4096,
    chunkSizeWarningLimit: 600,
    emptyOutDir: mode !== "fleet",
    rolldownOptions: { input: mode === "fleet" ? "fleet.html" : "index.html" },
  },
  server: { proxy: { "/v1": { target: planner, ws: true } } },
}));
