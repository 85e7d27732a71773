/** A place on the screen, CSS pixels: left, top, right, bottom. */
export type Box = readonly [number, number, number, number];

/**
 * Where labels stand already: who asks first gets the place, so the most important one asks first; one that would cover
 * another is left out.
 */
export class LabelRoom {
  private readonly taken: Box[] = [];

  /** Takes the place where nothing stands there; false, and nothing taken, where something does. */
  take(box: Box): boolean {
    if (this.taken.some((other) => overlaps(box, other))) return false;
    this.taken.push(box);
    return true;
  }
}

const overlaps = (a: Box, b: Box): boolean => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
