/**
 * Make the proof that a person meant a request: HMAC-SHA-256 over kind, robot, nonce and id, each
 * preceded by its length, as wire/operator_hmac.py does.
 *
 * Only a page that came by https, or from the robot's own machine, takes the key: any other may have
 * been written by whoever is on the path.
 */
import { hmac } from "@noble/hashes/hmac.js";
import { sha256 } from "@noble/hashes/sha2.js";
import { bytesToHex, concatBytes, utf8ToBytes } from "@noble/hashes/utils.js";
import { signal } from "@preact/signals";
import type { Status } from "../wire/types";
import type { Act } from "./api";
import { ApiError, newId } from "./api";

export type OperatorProof = {
  readonly id: string;
  readonly proof: { readonly nonce: string; readonly mac: string };
};

export const MIN_KEY_BYTES = 16;

/** The operator's key as the person typed it. In memory only: a reload forgets it. */
let key: Uint8Array | null = null;
export const hasKey = signal(false);

/** Say whether this page may ask for the operator's key. */
export const mayAskKey = (): boolean => globalThis.isSecureContext;

export function setKey(typed: string): boolean {
  const bytes = utf8ToBytes(typed.trim());
  key = mayAskKey() && bytes.length >= MIN_KEY_BYTES ? bytes : null;
  hasKey.value = key !== null;
  return hasKey.value;
}

export function forgetKey(): void {
  key?.fill(0);
  key = null;
  hasKey.value = false;
}

export function mac(secret: Uint8Array, ...parts: readonly string[]): string {
  const body = parts.flatMap((part) => {
    const bytes = utf8ToBytes(part);
    const length = new Uint8Array(4);
    new DataView(length.buffer).setUint32(0, bytes.length);
    return [length, bytes];
  });
  return bytesToHex(hmac(sha256, secret, concatBytes(...body)));
}

/** What set-up shows of the id of a begin, so that only the page that made it knows it (wire/trial_dialogue.py). */
export const markOf = (id: string): string => bytesToHex(sha256(utf8ToBytes(id))).slice(0, 32);

/** Say whether this robot moves metal, so that a person's key must sign. */
export const needsKey = (status: Status | null): boolean =>
  status !== null && !status.drive.virtual;

/**
 * Return the proof for one request, or null where none is needed.
 *
 * Throws ApiError where metal moves: `operator_key_insecure` where this page may not ask for the key,
 * `operator_key_needed` where none was typed.
 */
export function prove(kind: Act | "trial", status: Status | null): OperatorProof | null {
  if (!needsKey(status) || status === null || kind === "disarm" || kind === "estop") return null;
  if (!mayAskKey()) throw new ApiError("operator_key_insecure", "");
  if (key === null) throw new ApiError("operator_key_needed", "");
  const id = newId("page");
  return {
    id,
    proof: { nonce: status.nonce, mac: mac(key, kind, status.robot, status.nonce, id) },
  };
}

/** Return the proof that an operator means this very text, or null where none is needed; throws as `prove`. */
export function proveText(
  kind: "marks",
  text: string,
  status: Status | null,
): OperatorProof | null {
  if (!needsKey(status) || status === null) return null;
  if (!mayAskKey()) throw new ApiError("operator_key_insecure", "");
  if (key === null) throw new ApiError("operator_key_needed", "");
  const [id, digest] = [newId("page"), bytesToHex(sha256(utf8ToBytes(text)))];
  const { nonce, robot } = status;
  return { id, proof: { nonce, mac: mac(key, kind, robot, nonce, id, digest) } };
}

/** Return the proof that a goal carries: it clears a hold, so without one standing none is needed. */
export function proveGoal(status: Status | null): OperatorProof | null {
  return status?.held && needsKey(status) ? prove("resume", status) : null;
}
