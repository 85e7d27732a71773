import { defineConfig } from 'vitest/config';

/** Unit tests: pure model, decoding, map arithmetic. They need no browser and no server. */
export default defineConfig({
  esbuild: { jsx: 'automatic', jsxImportSource: 'preact' },
  test: { include: ['src/**/*_test.ts'], environment: 'node', passWithNoTests: false },
});
