/** Return a plot's y range: around the values, and never so near that noise looks like motion. */
export function span(low: number | null, high: number | null, least: number): [number, number] {
  const bottom = Math.min(low ?? 0, 0);
  const top = Math.max(high ?? 0, least);
  return [bottom < 0 ? Math.min(bottom, -least) * 1.1 : 0, top * 1.1];
}
