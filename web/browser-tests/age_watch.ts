import type { BrowserContext, Page } from 'playwright-core';

/** How old the newest picture was that the page had read, and what the page said of it, when it said that. */
export interface AgeSaid {
  /** By the wall's clock, which is one for the program, the browser and this test; the page uses none. */
  readonly trueS: number;
  readonly shownS: number;
  readonly badge: string;
}

interface Watched extends Window {
  newestWallMs: number;
  said: { trueS: number; shown: string; badge: string }[];
  agesRead: number[];
}

/** Looks at every message before the page does, and at every age that the page shows. For contexts without a page yet. */
export async function watchAges(context: BrowserContext): Promise<void> {
  await context.addInitScript(() => {
    const watched = window as unknown as Watched;
    [watched.newestWallMs, watched.said, watched.agesRead] = [0, [], []];
    const trueS = (): number => (Date.now() - watched.newestWallMs) / 1000;
    let gathered = 0;
    const read = (event: MessageEvent): void => {
      if (!(event.data instanceof ArrayBuffer)) return;
      const view = new DataView(event.data);
      const isPart = view.getUint8(4) === 7 && view.getUint8(5) === 0;
      if (isPart && view.getUint32(16, true) === 0) gathered = view.getFloat64(24 + 32, true);
      const isLast = isPart && view.getUint32(16, true) + view.getUint32(12, true) === view.getUint32(20, true);
      if (view.getUint8(4) === 1) watched.newestWallMs = view.getFloat64(32, true);
      else if (isLast) watched.newestWallMs = gathered;
      else return;
      watched.agesRead.push(trueS());
    };
    window.WebSocket = class extends WebSocket {
      constructor(...how: ConstructorParameters<typeof WebSocket>) {
        super(...how);
        this.addEventListener('message', read);
      }
    };
    const textOf = (id: string): string => document.querySelector(`[data-testid="${id}"]`)?.textContent ?? '';
    let last = '';
    const look = (): void => {
      const shown = textOf('data-age');
      if (shown === last || watched.newestWallMs === 0) return;
      last = shown;
      watched.said.push({ trueS: trueS(), shown, badge: textOf('badge') });
    };
    new MutationObserver(look).observe(document, { subtree: true, childList: true, characterData: true });
  });
}

/** How old each snapshot was when the page read it, since the last time this was asked. */
export const agesRead = (page: Page): Promise<number[]> =>
  page.evaluate(() => (window as unknown as Watched).agesRead.splice(0));

/** Every age that the page has shown since the last time this was asked. */
export async function agesSaid(page: Page): Promise<AgeSaid[]> {
  const said = await page.evaluate(() => (window as unknown as Watched).said.splice(0));
  return said.map(({ trueS, shown, badge }) => ({ trueS, shownS: secondsIn(shown), badge }));
}

/** As the page writes ages: 270 ms, 1.2 s, 12 s, 1:05. */
function secondsIn(text: string): number {
  const clock = /^(\d+):(\d\d)$/.exec(text);
  if (clock) return 60 * Number(clock[1]) + Number(clock[2]);
  return Number.parseFloat(text) / (text.endsWith('ms') ? 1000 : 1);
}
