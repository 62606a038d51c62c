/** Write samples as a WAV: one channel of 16 bits. Pure. */

export const RATE_HZ = 16_000;

export function wav(samples: Float32Array, rateHz: number = RATE_HZ): ArrayBuffer {
  const data = new ArrayBuffer(44 + 2 * samples.length);
  const view = new DataView(data);
  const tag = (at: number, text: string): unknown =>
    Array.from(text, (one, index) => view.setUint8(at + index, one.charCodeAt(0)));
  tag(0, "RIFF");
  view.setUint32(4, 36 + 2 * samples.length, true);
  tag(8, "WAVEfmt ");
  view.setUint32(16, 16, true);
  view.setUint16(20, 1, true); // PCM
  view.setUint16(22, 1, true); // one channel
  view.setUint32(24, rateHz, true);
  view.setUint32(28, 2 * rateHz, true);
  view.setUint16(32, 2, true);
  view.setUint16(34, 16, true);
  tag(36, "data");
  view.setUint32(40, 2 * samples.length, true);
  samples.forEach((sample, index) => {
    const within = Number.isFinite(sample) ? Math.max(-1, Math.min(1, sample)) : 0;
    view.setInt16(44 + 2 * index, Math.round(within * 32767), true);
  });
  return data;
}
