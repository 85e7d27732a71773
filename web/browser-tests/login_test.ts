import { execFileSync } from 'node:child_process';
import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { violationsOf } from './axe';
import { keepPicture, openBrowser, openView, type View } from './chromium';
import { serve, type Program } from './program';

/** The console as it is reached from elsewhere: over TLS, with a token. Tokens make the program ask on any address. */

const kOperator = 'operator-token-of-this-test';
const kViewer = 'viewer-token-of-this-test';

let browser: Browser;
let folder: string;
let program: Program;
let view: View;
let page: Page;

beforeAll(async () => {
  [browser, folder] = [await openBrowser(), await mkdtemp(join(tmpdir(), 'vigil-login-'))];
  await writeFile(join(folder, 'tokens'), `operator ${kOperator}\nviewer ${kViewer}\n`);
  const request = 'req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 1 -subj /CN=127.0.0.1';
  const options = [...request.split(' '), '-addext', 'subjectAltName=IP:127.0.0.1'];
  execFileSync('openssl', [...options, '-keyout', 'key.pem', '-out', 'certificate.pem'], {
    cwd: folder,
    stdio: 'pipe',
  });
});
afterAll(async () => {
  await browser.close();
  await rm(folder, { recursive: true });
});
beforeEach(async () => {
  const file = (name: string): string => join(folder, name);
  const tls = ['--certificate', file('certificate.pem'), '--key', file('key.pem')];
  program = await serve('paper.yaml', ['--tokens', file('tokens'), ...tls]);
  // Nobody has signed the test's certificate.
  view = await openView(browser, { ignoreHTTPSErrors: true });
  page = view.page;
  await page.goto(program.address);
  await page.getByRole('heading', { name: 'The program wants a token' }).waitFor();
});
afterEach(async () => {
  await view.context.close();
  await program.stop();
  expect(view.complaints).toEqual([]);
});

async function logIn(name: string, token: string): Promise<void> {
  await page.getByLabel('Name').fill(name);
  await page.getByLabel('Token').fill(token);
  await page.getByRole('button', { name: 'Connect' }).click();
}

describe('a console that is reached over TLS', () => {
  it('shows nothing before somebody logs in, and says what is wrong with a token', async () => {
    expect(program.address).toMatch(/^https:/);
    expect(await page.getByRole('row', { name: /cf1/ }).count()).toBe(0);
    expect(await page.getByRole('button', { name: 'LAND ALL' }).isDisabled()).toBe(true);
    expect(await violationsOf(page)).toEqual([]);
    await keepPicture(page, 'login');
    await logIn('Ana', 'operator-token-of-that-test');
    await page.getByText(/This token opens nothing/).waitFor();
    await keepPicture(page, 'login_refused');
  });

  it('lets an operator command drones, and stop no motors', async () => {
    await logIn('Ana', kOperator);
    await page.getByTestId('badge').getByText('SIM').waitFor();
    await page.getByRole('button', { name: 'Operators: Ana, operator' }).waitFor();
    expect(page.url()).not.toContain(kOperator);
    expect(await page.getByRole('button', { name: /Emergency stop of all drones/ }).isDisabled()).toBe(true);
    await keepPicture(page, 'logged_in');
    await page.getByRole('button', { name: 'LAND ALL' }).click();
    await page
      .getByRole('row', { name: /cf1/ })
      .getByText(/Landing|Grounded/)
      .waitFor();
  });

  it('lets a viewer look', async () => {
    await logIn('Ben', kViewer);
    await page.getByTestId('badge').getByText('SIM').waitFor();
    expect(await page.getByRole('button', { name: 'LAND ALL' }).isDisabled()).toBe(true);
    expect(await page.getByRole('radio', { name: 'Point' }).isDisabled()).toBe(true);
  });

  it('speaks to nobody without TLS', async () => {
    await expect(fetch(program.address.replace('https:', 'http:'))).rejects.toThrow();
  });
});
