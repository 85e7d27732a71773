import type { Page } from 'playwright-core';

/** The CSS pixel of a place of a field of 3 x 3 m around the origin, which fills the map but for 36 pixels, and 72 on its right. */
export async function pixelOf(page: Page, x: number, y: number): Promise<{ x: number; y: number }> {
  const box = (await page.locator('.map-field').boundingBox())!;
  const scale = Math.min(box.width - 108, box.height - 72) / 3;
  return { x: box.x + box.width / 2 - 18 + scale * x, y: box.y + box.height / 2 - scale * y };
}
