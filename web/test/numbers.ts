/** Return rows of numbers from -1 to 1 that are the same on each run. */
export function someNumbers(rows: number, columns: number, seed = 7): number[][] {
  let state = seed;
  const next = (): number => {
    state = (state * 1664525 + 1013904223) % 4294967296;
    return (2 * state) / 4294967296 - 1;
  };
  return Array.from({ length: rows }, () => Array.from({ length: columns }, next));
}
