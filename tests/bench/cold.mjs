// The table of `./dev bench cold`: each preset without caches, slowest first, beside the stored figures of the last release.
import fs from 'node:fs';

const aims = { 50: 1.5, 90: 16, 99: 100 }; // percentile -> milliseconds
const stored_file = 'tests/bench/cold_release.json';

/** The value below which this share (in percent) of the sorted values lies. */
function percentile(sorted, percent) {
  return sorted[Math.min(sorted.length - 1, Math.floor((sorted.length * percent) / 100))];
}

/** Whole towns and worlds have another order of size than single models. */
const is_large = (row) => ['city', 'world'].includes(row.generator);

function print_percentiles(heading, times) {
  const sorted = times.map((row) => row.milliseconds).sort((a, b) => a - b);
  console.log(`${heading}: ${sorted.length} presets`);
  for (const [percent, aim] of Object.entries(aims)) {
    const value = percentile(sorted, Number(percent));
    console.log(`p${percent}: ${value.toFixed(2)} ms (aim ${aim}): ${value <= aim ? 'ok' : 'MISSED'}`);
  }
}

/** Prints the table of rows {name, generator, seconds, textures, stages}. With `store`, writes them as the figures of a release. */
export function print_cold(rows, store) {
  const stored = fs.existsSync(stored_file) ? JSON.parse(fs.readFileSync(stored_file, 'utf8')) : {};
  const times = rows.map((row) => ({ ...row, milliseconds: row.seconds * 1e3 })).sort((a, b) => b.milliseconds - a.milliseconds);
  for (const { name, milliseconds, textures = 0, stages = {} } of times) {
    const parts = Object.entries(stages).map(([stage, spent]) => `${stage} ${spent.toFixed(1)}`).join(', ');
    const before = stored[name] === undefined ? '' : `  last release ${stored[name].toFixed(2).padStart(8)} ms, ratio ${(milliseconds / stored[name]).toFixed(2)}`;
    console.log(`${name.padEnd(32)} ${milliseconds.toFixed(2).padStart(8)} ms  textures ${(textures * 1e3).toFixed(1).padStart(6)}; ${parts}${before}`);
  }
  print_percentiles('all', times);
  print_percentiles('without cities and worlds', times.filter((row) => !is_large(row)));
  if (store) {
    const table = Object.fromEntries(times.map((row) => [row.name, Number(row.milliseconds.toFixed(3))]).sort(([a], [b]) => (a < b ? -1 : 1)));
    fs.writeFileSync(stored_file, `${JSON.stringify(table, null, 1)}\n`);
  }
}
