import type { Browser, Page } from 'playwright-core';
import { openView, type View } from './chromium';

export type ViewOptions = NonNullable<Parameters<typeof openView>[1]>;

/** The pages that one test looks at the real program with. */
export class Views {
  private opened: View[] = [];

  /** A page of its own on the console at this address, once its badge says what is shown. */
  async look(browser: Browser, address: string, badge: 'SIM' | 'REPLAY', options: ViewOptions = {}): Promise<Page> {
    const view = await openView(browser, options);
    this.opened.push(view);
    await view.page.goto(address);
    await view.page.getByTestId('badge').getByText(badge).waitFor();
    return view.page;
  }

  /** Closes them all; what they complained of. */
  async close(): Promise<readonly string[]> {
    const views = this.opened;
    this.opened = [];
    for (const view of views) await view.context.close();
    return views.flatMap((view) => view.complaints);
  }
}
