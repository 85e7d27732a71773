/** What the age map's strongest tint stands for, s: a round number that the oldest seen place does not exceed by much. */
export function ageScale(oldestS: number, deadlineS: number | null): number {
  const wanted = deadlineS ?? Math.max(oldestS, 10);
  const power = 10 ** Math.floor(Math.log10(wanted));
  return ([1, 2, 3, 5, 10].find((factor) => factor * power >= wanted) ?? 10) * power;
}
