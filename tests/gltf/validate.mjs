// Holds glTF files against Khronos' validator: node validate.mjs FILE…; prints one JSON line a file and ends with 1 if any has an error.
import fs from 'node:fs';
import { createRequire } from 'node:module';

const validator = createRequire(import.meta.url)('gltf-validator');
let bad = 0;
for (const file of process.argv.slice(2)) {
  const { issues } = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { maxIssues: 20 });
  const messages = issues.messages.filter((issue) => issue.severity < 2).map((issue) => `${issue.code} ${issue.pointer}: ${issue.message}`);
  console.log(JSON.stringify({ file, errors: issues.numErrors, warnings: issues.numWarnings, messages }));
  bad += issues.numErrors;
}
process.exit(bad ? 1 : 0);
