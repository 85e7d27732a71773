import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, expect } from 'vitest';
import { openBrowser, openView, type View } from './chromium';
import type { FakeProgram } from './fake_program';
import { servePage } from './page_server';

const kStepMs = 50;

/** A page of its own for every test of a file, with a program that the test plays. */
export function usePlayedPage(): PlayedPage {
  const played = new PlayedPage();
  beforeAll(() => played.open());
  afterAll(() => played.close());
  afterEach(() => played.end());
  return played;
}

class PlayedPage {
  private browser: Browser | null = null;
  private site: Awaited<ReturnType<typeof servePage>> | null = null;
  private view: View | null = null;
  private steps: NodeJS.Timeout | undefined;

  /** The page of the test that runs: there once it began. */
  get page(): Page {
    return this.view!.page;
  }

  /** Opens the page on this program, which flies from now on; done when the page shows that it is live. */
  async begin(program: FakeProgram, options: Parameters<typeof openView>[1] = {}): Promise<void> {
    this.view = await openView(this.browser!, options);
    await program.attach(this.page);
    this.steps = setInterval(() => program.step(), kStepMs);
    await this.page.goto(this.site!.address);
    await this.page.getByTestId('badge').getByText('SIM').waitFor();
  }

  /** The program says nothing of the flight any more. */
  freeze(): void {
    clearInterval(this.steps);
  }

  async open(): Promise<void> {
    [this.browser, this.site] = [await openBrowser(), await servePage()];
  }

  /** A page that complained fails its test. */
  async end(): Promise<void> {
    this.freeze();
    expect(this.view?.complaints).toEqual([]);
    await this.view?.context.close();
  }

  async close(): Promise<void> {
    await this.browser?.close();
    await this.site?.close();
  }
}
