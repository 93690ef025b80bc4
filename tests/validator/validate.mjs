// The Khronos validator over glTF files: node validate.mjs <file.glb | file.gltf | folder of such> ...
// Prints every message that is not accepted below and exits with status 1 if there is one, be it only a hint.
import fs from 'node:fs';
import path from 'node:path';
import validator from 'gltf-validator';

// Remarks on what we do on purpose: texture coordinates for lightmaps, wind and the user's own materials are read by engines
// and not by the materials of the file; tangents are left to the importer where the request says so.
const accepted = ({ code, pointer }) =>
  (code === 'UNUSED_OBJECT' && /\/TEXCOORD_\d$/.test(pointer)) || code === 'MESH_PRIMITIVE_GENERATED_TANGENT_SPACE';
const severities = ['error', 'warning', 'information', 'hint'];

async function faults(file) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
    uri: path.basename(file),
    maxIssues: 0,
    externalResourceFunction: async (uri) =>
      new Uint8Array(fs.readFileSync(path.resolve(path.dirname(file), decodeURIComponent(uri)))),
  });
  return report.issues.messages.filter((message) => !accepted(message));
}

/** The file itself, or the glTF files of a folder. */
function files_of(name) {
  if (!fs.statSync(name).isDirectory()) return [name];
  const inside = fs.readdirSync(name).filter((entry) => /\.(glb|gltf)$/.test(entry));
  return inside.sort().map((entry) => path.join(name, entry));
}

const files = process.argv.slice(2).flatMap(files_of);
if (files.length === 0) {
  console.error('usage: node validate.mjs <file.glb | file.gltf | folder of such> ...');
  process.exit(2);
}
let failed = false;
for (const file of files) {
  const found = await faults(file);
  for (const { severity, code, message, pointer } of found) {
    console.log(`${file}: ${severities[severity]} ${code} ${pointer ?? ''} ${message}`);
  }
  failed ||= found.length > 0;
}
if (!failed) console.log(`${files.length} files without a fault`);
process.exit(failed ? 1 : 0);
