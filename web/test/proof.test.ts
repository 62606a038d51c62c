import { utf8ToBytes } from "@noble/hashes/utils.js";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { forgetKey, hasKey, mac, markOf, prove, proveGoal, setKey } from "../src/net/proof";
import { status } from "./examples";

const METAL = { ...status, drive: { ...status.drive, virtual: false, kind: "serial" } };
const HELD = { ...METAL, held: { reason: "stop", id: "s1" } };

beforeEach(() => vi.stubGlobal("isSecureContext", true));
afterEach(() => {
  forgetKey();
  vi.unstubAllGlobals();
});

describe("markOf", () => {
  // Made by wire/trial_dialogue.py: mark_of("page-0011"); tests/pons/robot holds Python to it.
  it("equals set-up's", () => {
    expect(markOf("page-0011")).toBe("10907a7983adcea612788bdde4905ac4");
  });
});

describe("mac", () => {
  // Both made by wire/operator_hmac.py: sign(key, kind, robot, nonce, id).mac; tests/web holds Python to it.
  it("equals the bridge's", () => {
    const key = utf8ToBytes("a key of sixteen bytes or more");
    expect(mac(key, "arm", "r1", "dd62bd0cedb5.5", "page-0011")).toBe(
      "9dc5ad5bf6a76f95069480a0b3698843788e7e3580de3627636a6a37ba9bd4bc",
    );
  });

  it("takes a key as UTF-8", () => {
    expect(mac(utf8ToBytes("钥匙钥匙钥匙"), "resume", "r1", "n-1", "page-x")).toBe(
      "5db6338fdd4c27ed5b92879300b30cd2a83663b58bb97f4316f423e5cd45b05a",
    );
  });

  it("tells apart what lengths alone divide", () => {
    const key = utf8ToBytes("0123456789abcdef");
    expect(mac(key, "ab", "c")).not.toBe(mac(key, "a", "bc"));
  });
});

describe("prove", () => {
  it("makes none for a drive that is virtual", () => {
    expect(prove("arm", status)).toBeNull();
    expect(proveGoal({ ...status, held: { reason: "stop", id: "s1" } })).toBeNull();
  });

  it("makes none for what needs none", () => {
    expect(prove("disarm", METAL)).toBeNull();
    expect(prove("estop", METAL)).toBeNull();
    expect(proveGoal(METAL)).toBeNull();
  });

  it("asks for the key on metal", () => {
    expect(() => prove("arm", METAL)).toThrow("operator_key_needed");
    expect(() => proveGoal(HELD)).toThrow("operator_key_needed");
  });

  it("takes no key and signs nothing on a page that came in clear", () => {
    vi.stubGlobal("isSecureContext", false);
    expect(setKey("0123456789abcdef")).toBe(false);
    expect(hasKey.value).toBe(false);
    expect(() => prove("arm", METAL)).toThrow("operator_key_insecure");
    expect(() => proveGoal(HELD)).toThrow("operator_key_insecure");
    expect(prove("estop", METAL)).toBeNull();
    expect(prove("arm", status)).toBeNull();
  });

  it("signs with the key that was typed, for this nonce, under a new id each time", () => {
    expect(setKey("  0123456789abcdef\n")).toBe(true);
    const [one, two] = [prove("arm", METAL), proveGoal(HELD)];
    const key = utf8ToBytes("0123456789abcdef");
    expect(one?.proof.nonce).toBe(METAL.nonce);
    expect(one?.proof.mac).toBe(mac(key, "arm", METAL.robot, METAL.nonce, one?.id ?? ""));
    expect(two?.proof.mac).toBe(mac(key, "resume", METAL.robot, METAL.nonce, two?.id ?? ""));
    expect(one?.id).not.toBe(two?.id);
    expect(one?.id).toMatch(/^[A-Za-z0-9][A-Za-z0-9_.:-]{0,63}$/);
  });

  it("takes no key that is too short, and forgets", () => {
    expect(setKey("too short")).toBe(false);
    expect(hasKey.value).toBe(false);
    setKey("0123456789abcdef");
    forgetKey();
    expect(() => prove("arm", METAL)).toThrow("operator_key_needed");
  });
});
