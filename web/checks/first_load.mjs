// Adds up what a browser loads first, compressed as the server sends it: node checks/first_load.mjs [LIMIT in KiB]
// Exits 1 when that is more than the limit.
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const limitKiB = Number(process.argv[2] ?? 100);
const dist = fileURLToPath(new URL('../dist', import.meta.url));

/** What index.html names, which is everything but what a click loads later. */
function firstLoad() {
  const page = readFileSync(join(dist, 'index.html'), 'utf8');
  const named = [...page.matchAll(/(?:src|href)="\.?\/?([^"]+)"/g)].map((match) => match[1]);
  return ['index.html', ...named];
}

const files = firstLoad();
if (files.length < 3) throw new Error('dist/index.html names no script and style sheet: build first');
let total = 0;
for (const file of files) {
  const bytes = gzipSync(readFileSync(join(dist, file)), { level: 9 }).length;
  total += bytes;
  console.log(`${(bytes / 1024).toFixed(1).padStart(7)} KiB  ${file}`);
}
const all = readdirSync(dist, { recursive: true, withFileTypes: true }).filter((entry) => entry.isFile()).length;
console.log(
  `${(total / 1024).toFixed(1).padStart(7)} KiB  first load, gzipped (limit ${limitKiB} KiB; ${all} files in all)`,
);
if (total > limitKiB * 1024) {
  console.error('The first load is over its limit: load later what the first view does not need.');
  process.exit(1);
}
