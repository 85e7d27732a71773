/**
 * The rows of a table that somebody is about to click: those that stand there stay where they are, also when they would
 * go now; those that came are added at the end. Pure.
 */
export function steadyRows(shown: readonly number[], wanted: readonly number[]): readonly number[] {
  const isShown = new Set(shown);
  const came = wanted.filter((row) => !isShown.has(row));
  return came.length === 0 ? shown : [...shown, ...came];
}
