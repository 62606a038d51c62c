/**
 * Hold the API token that a planner on an outside address asks for. It comes from the address's
 * fragment (which no server sees) or from the person, and lives as long as the browser's tab.
 */
import { signal } from "@preact/signals";

/** One origin may serve several robots, each below a path of its own and with a token of its own. */
const slot = (): string => `pons.token ${location.pathname}`;

export const tokenNeeded = signal(false);
let token = "";

/** Take what the address's fragment brings, and out of the address; return the operator's key, if it came. */
export function startToken(): string {
  const brought = new URLSearchParams(location.hash.slice(1));
  const [given, key] = [brought.get("token"), brought.get("key")];
  if (given) setToken(given);
  else token = sessionStorage.getItem(slot()) ?? "";
  if (given || key) window.history.replaceState(null, "", location.pathname + location.search);
  return key ?? "";
}

export function setToken(given: string): void {
  token = given.trim();
  sessionStorage.setItem(slot(), token);
  tokenNeeded.value = false;
}

export type Authorization = { readonly authorization?: string };

export function authorization(): Authorization {
  return token ? { authorization: `Bearer ${token}` } : {};
}

/** Ask for a token where the one sent was refused; an answer from before the newest says nothing of it. */
export function askForToken(sent: Authorization): void {
  if (sent.authorization === authorization().authorization) tokenNeeded.value = true;
}

/** Return what a WebSocket offers: it can set no header, so the token goes as a subprotocol. */
export function subprotocols(): string[] {
  return token ? ["pons.v1", `bearer.${base64url(token)}`] : ["pons.v1"];
}

function base64url(text: string): string {
  const bytes = new TextEncoder().encode(text);
  return btoa(String.fromCharCode(...bytes))
    .replaceAll("+", "-")
    .replaceAll("/", "_")
    .replaceAll("=", "");
}
