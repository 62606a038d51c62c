import { describe, expect, it } from "vitest";
import { wav } from "../src/talk/wav";

describe("a recording", () => {
  it("is one channel of 16 bits, clipped, with sizes that are true", () => {
    const view = new DataView(wav(new Float32Array([0, 0.5, -1, 2, Number.NaN]), 8000));
    const text = (at: number) =>
      String.fromCharCode(...[0, 1, 2, 3].map((n) => view.getUint8(at + n)));
    expect([text(0), text(8), text(12), text(36)]).toEqual(["RIFF", "WAVE", "fmt ", "data"]);
    expect(view.getUint32(4, true)).toBe(view.byteLength - 8);
    expect([view.getUint16(20, true), view.getUint16(22, true)]).toEqual([1, 1]);
    expect([view.getUint32(24, true), view.getUint32(28, true)]).toEqual([8000, 16000]);
    expect(view.getUint32(40, true)).toBe(10);
    const samples = [0, 1, 2, 3, 4].map((n) => view.getInt16(44 + 2 * n, true));
    expect(samples).toEqual([0, 16384, -32767, 32767, 0]);
  });
});
