// The Khronos validator over glTF files: node validate.mjs <file.glb | file.gltf | folder of such> ...
// Prints every message that is not accepted below and exits with status 1 if there is one, be it only a hint.
import fs from 'node:fs';
import path from 'node:path';
import validator from 'gltf-validator';

// Extensions that the validator does not know. What only they refer to (copies, coarser levels) it takes for unused.
const unknown = /EXT_meshopt_compression|EXT_mesh_gpu_instancing|MSFT_lod|KHR_materials_diffuse_transmission|OMI_physics|GODOT_single_root/;

// Remarks on what we do on purpose: texture coordinates for lightmaps, wind and the user's own materials are read by engines
// and not by the materials of the file; tangents are left to the importer where the request says so.
const accepted = ({ code, pointer, message }, extended) =>
  (code === 'UNSUPPORTED_EXTENSION' && unknown.test(message)) ||
  (code === 'UNUSED_OBJECT' && extended && /^\/(accessors|nodes|meshes|skins|materials|bufferViews|buffers)\/\d+$/.test(pointer)) ||
  (code === 'UNUSED_OBJECT' && /\/TEXCOORD_\d$/.test(pointer)) || code === 'MESH_PRIMITIVE_GENERATED_TANGENT_SPACE';
const severities = ['error', 'warning', 'information', 'hint'];

async function faults(file) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
    uri: path.basename(file),
    maxIssues: 0,
    externalResourceFunction: async (uri) =>
      new Uint8Array(fs.readFileSync(path.resolve(path.dirname(file), decodeURIComponent(uri)))),
  });
  const extended = (report.info?.extensionsUsed ?? []).some((name) => unknown.test(name));
  return report.issues.messages.filter((message) => !accepted(message, extended));
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
