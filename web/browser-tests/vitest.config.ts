import { defineConfig } from 'vitest/config';

/** Tests in a real Chromium, one file after the other: two cores have enough to do with a browser and a program. */
export default defineConfig({
  test: {
    include: ['browser-tests/**/*_test.ts'],
    environment: 'node',
    fileParallelism: false,
    testTimeout: 60_000,
    hookTimeout: 60_000,
    passWithNoTests: false,
    expect: { poll: { timeout: 20_000, interval: 50 } },
  },
});
