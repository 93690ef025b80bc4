// The same derivation by the peer, npm lindenmayer: CPU time of iterate() and of flattening the resulting
// string, without start-up.
import LSystem from 'lindenmayer';

function seconds_of(steps) {
  const lsystem = new LSystem({ axiom: 'F', productions: { F: 'FF-[-F+F+F]+[+F-F-F]' } });
  const start = process.cpuUsage();
  lsystem.iterate(steps);
  const text = lsystem.getString();
  text.charCodeAt(text.length - 1); // flattens the rope that the JavaScript engine builds
  return { length: text.length, seconds: (({ user, system }) => (user + system) / 1e6)(process.cpuUsage(start)) };
}

for (const steps of [7, 8]) {
  const runs = [];
  for (let round = 0; round < 6; round += 1) runs.push(seconds_of(steps));
  const seconds = runs.slice(1).map((run) => run.seconds).sort((a, b) => a - b)[2];
  console.log(JSON.stringify({ name: `D0L bush n=${steps}`, unit: 'modules', amount: runs[0].length, seconds }));
}
