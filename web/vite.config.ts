// Build the page into dist/, every file but index.html named by its hash. Asks nobody outside.
import { defineConfig } from "vite";

declare const process: { readonly env: Record<string, string | undefined> };
const planner = process.env.PONS_URL ?? "http://127.0.0.1:8420";

export default defineConfig({
  base: "./", // a proxy may serve the page below a path of its own
  build: {
    target: "es2022",
    modulePreload: { polyfill: false },
    assetsInlineLimit: 4096,
    chunkSizeWarningLimit: 600,
  },
  server: { proxy: { "/v1": { target: planner, ws: true } } },
});
