// What deploy/ ships is what it says: manifests after the schemas of Kubernetes, settings that there are, metrics that there are.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import crypto from 'node:crypto';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import yaml from 'yaml';
import { ask, rehearsal, run, serve, until } from '../http/support.mjs';

const root = path.resolve(path.dirname(new URL(import.meta.url).pathname), '../..');
const deploy = path.join(root, 'deploy');
const read = (name) => fs.readFileSync(path.join(deploy, name), 'utf8');
const folders = ['kubernetes/service', 'kubernetes/batch', 'kubernetes/tiles'];
const manifests = (folder) => fs.readdirSync(path.join(deploy, folder)).filter((name) => name.endsWith('.yaml') && name !== 'kustomization.yaml').map((name) => ({ name: `${folder}/${name}`, object: yaml.parse(read(`${folder}/${name}`)) }));
const every = folders.flatMap(manifests);
const of_kind = (kind) => every.find(({ object }) => object.kind === kind).object;

test('every manifest is valid after the schema of its kind', async () => {
  for (const { name, object } of every) {
    const { [object.kind]: Model } = await import(`kubernetes-models/${object.apiVersion}`);
    assert.doesNotThrow(() => new Model(object).validate(), name);
  }
  const broken = structuredClone(of_kind('Deployment'));
  broken.spec.template.spec.containers[0].ports[0].containerPort = 'http';
  const { Deployment } = await import('kubernetes-models/apps/v1');
  assert.throws(() => new Deployment(broken).validate(), /containerPort/, 'the schemas do look');
});

test('each folder lists the files that are in it, and no other', () => {
  for (const folder of folders) {
    const listed = yaml.parse(read(`${folder}/kustomization.yaml`)).resources.map((name) => `${folder}/${name}`).sort();
    assert.deepEqual(listed, manifests(folder).map(({ name }) => name).sort());
  }
});

test('kubectl makes one of each folder', { skip: spawnSync('kubectl', ['version', '--client']).error ? 'there is no kubectl here' : false }, () => {
  for (const folder of folders) {
    const { status, stdout, stderr } = spawnSync('kubectl', ['kustomize', path.join(deploy, folder)], { encoding: 'utf8' });
    assert.equal(status, 0, stderr);
    assert.ok(yaml.parseAllDocuments(stdout).length >= 2);
  }
});

test('selectors find the pods, and ports have the names that are asked for', () => {
  const { template, selector } = of_kind('Deployment').spec;
  const holds = (wanted) => Object.entries(wanted).every(([key, value]) => template.metadata.labels[key] === value);
  assert.ok(holds(selector.matchLabels));
  assert.ok(holds(of_kind('Service').spec.selector));
  assert.ok(holds(of_kind('PodDisruptionBudget').spec.selector.matchLabels));
  assert.ok(holds(of_kind('NetworkPolicy').spec.podSelector.matchLabels));
  const ports = template.spec.containers[0].ports.map((port) => port.name);
  assert.ok(ports.includes(of_kind('Service').spec.ports[0].targetPort) && ports.includes('http'));
  assert.equal(of_kind('HorizontalPodAutoscaler').spec.scaleTargetRef.name, of_kind('Deployment').metadata.name);
});

test('pods have no right that they do not need', () => {
  for (const { object } of every.filter(({ object: { kind } }) => ['Deployment', 'Job'].includes(kind))) {
    const { spec } = object.spec.template;
    assert.equal(spec.securityContext.runAsNonRoot, true);
    assert.equal(spec.securityContext.seccompProfile.type, 'RuntimeDefault');
    assert.equal(spec.automountServiceAccountToken, false);
    for (const { securityContext, resources } of spec.containers) {
      assert.deepEqual([securityContext.readOnlyRootFilesystem, securityContext.allowPrivilegeEscalation, securityContext.capabilities.drop], [true, false, ['ALL']]);
      assert.ok(resources.limits.memory && resources.requests.cpu);
    }
  }
});

test('a pod has the time that draining takes', () => {
  const literals = Object.fromEntries(yaml.parse(read('kubernetes/service/kustomization.yaml')).configMapGenerator[0].literals.map((each) => each.split('=')));
  const { terminationGracePeriodSeconds } = of_kind('Deployment').spec.template.spec;
  assert.ok(terminationGracePeriodSeconds > Number(literals.SEEDMESH_DRAIN_DELAY) + Number(literals.SEEDMESH_TIME_LIMIT));
});

test('no balancer gives a request that has timed out to another replica', () => {
  const nginx = read('nginx/nginx.conf');
  const seconds = (name) => Number(new RegExp(`^\\s*${name} (\\d+)s;`, 'm').exec(nginx)?.[1]);
  assert.ok(seconds('proxy_next_upstream_timeout') < seconds('proxy_read_timeout'), 'a retry must not follow a read timeout');
  assert.ok(seconds('proxy_next_upstream_timeout') > seconds('proxy_connect_timeout'), 'a retry must follow a connect timeout');
  const haproxy = read('haproxy/haproxy.cfg');
  assert.doesNotMatch(/^\s*retry-on (.*)$/m.exec(haproxy)[1], /response-timeout|all-retryable-errors/);
});

test('the shares of a batch are as many as its pods', () => {
  const jobs = every.filter(({ object }) => object.kind === 'Job');
  assert.equal(jobs.length, 2);
  for (const { object: { spec } } of jobs) {
    const { args } = spec.template.spec.containers[0];
    assert.equal(args[args.indexOf('--part') + 1], `$(JOB_COMPLETION_INDEX)/${spec.completions}`);
  }
});

test('nginx refuses no tile for its number', () => {
  const tiles = /location \/v1\/worlds\/ \{([^}]*)\}/.exec(read('nginx/nginx.conf'))[1];
  assert.match(tiles, /proxy_cache models;/);
  assert.doesNotMatch(tiles, /limit_/);
});

const mebibytes = (text) => Number(/^(\d+)/.exec(text)[1]) * { MiB: 1, GiB: 1024, Mi: 1, Gi: 1024, m: 1, g: 1024 }[/[A-Za-z]+$/.exec(text)[0]];

/** The memory formula of deploy/README.md in MiB, with variables over the defaults of the program. */
async function memory_of(variables, threads) {
  const { out } = await run(rehearsal, ['serve', '--print-config'], { env: { ...variables, SEEDMESH_THREADS: String(threads) } });
  const of = (name) => JSON.parse(out)[name] / 2 ** 20;
  return threads * of('max-memory') + Math.max(of('memory-in-flight'), of('max-output')) + of('body-memory') + of('cache-bytes') + of('texture-bytes') + of('world-bytes') + 64;
}

test('both pages give one formula of memory, its example is right, and every deployment has that memory', async () => {
  const formula = /^The process uses at most\n\n(.+)\n\n(.+= (\d+) MiB)\./m;
  const [, words, example, number] = formula.exec(read('README.md'));
  const [, other_words, other_example] = formula.exec(read('../docs/operating.md'));
  assert.equal(words, other_words);
  assert.equal(example, other_example);
  assert.equal(await memory_of({}, 2), Number(number));
  const replicas = yaml.parse(read('compose.replicas.yaml')).services;
  for (const service of [yaml.parse(read('compose.yaml')).services.seedmesh, replicas['seedmesh-1'], replicas['seedmesh-2']])
    assert.ok(await memory_of(service.environment, service.cpus) <= mebibytes(service.mem_limit));
  const literals = Object.fromEntries(yaml.parse(read('kubernetes/service/kustomization.yaml')).configMapGenerator[0].literals.map((each) => each.split('=')));
  const { limits } = of_kind('Deployment').spec.template.spec.containers[0].resources;
  assert.ok(await memory_of(literals, Number(limits.cpu)) <= mebibytes(limits.memory));
});

test('every variable that is set somewhere is a setting, or one of a build or bench', async () => {
  const files = ['README.md', 'compose.yaml', 'compose.replicas.yaml', 'kubernetes/service/kustomization.yaml', 'kubernetes/service/deployment.yaml', '../Dockerfile', '../docs/operating.md'];
  const { out } = await run(rehearsal, ['serve', '--print-config']);
  const settings = Object.keys(JSON.parse(out)).map((name) => `SEEDMESH_${name.toUpperCase().replaceAll('-', '_')}`);
  const known = new Set([...settings, 'SEEDMESH_CONFIG', 'SEEDMESH_TESTS', 'SEEDMESH_ENGINE', 'SEEDMESH_BASE', 'SEEDMESH_STORE_COLD']);
  for (const file of files) for (const [name] of read(file).matchAll(/SEEDMESH_[A-Z_]+[A-Z]/g)) assert.ok(known.has(name), `${file}: ${name}`);
});

test('the compose file starts nginx before two replicas that answer', { skip: spawnSync('nginx', ['-v']).error ? 'there is no nginx here' : false }, async () => {
  const { services } = yaml.parse(read('compose.replicas.yaml'));
  const edit = /^sed '([^']+)' \S+ >(\S+) && exec nginx -c (\S+) /.exec(services.nginx.command[2]);
  assert.equal(edit[2], edit[3]);
  const { stdout: shipped } = spawnSync('sed', [edit[1], path.join(deploy, 'nginx/nginx.conf')], { encoding: 'utf8' });
  const names = new Set([...shipped.matchAll(/server (seedmesh-\d):8080/g)].map(([, name]) => name));
  assert.deepEqual([...names], Object.keys(services).filter((name) => name.startsWith('seedmesh-')));
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'seedmesh-compose-'));
  fs.chmodSync(folder, 0o777);
  const replicas = await Promise.all([...names].map(() => serve(rehearsal)));
  const port = 18151;
  let text = shipped.replace('worker_processes auto;', 'daemon off; worker_processes 1;').replaceAll('/tmp/nginx.pid', `${folder}/pid`).replaceAll('/var/cache/nginx', `${folder}/cache`).replace('listen 8000;', `listen 127.0.0.1:${port};`)
    .replace('  access_log off;', ['client_body', 'proxy', 'fastcgi', 'uwsgi', 'scgi'].map((name) => `  ${name}_temp_path ${folder}/${name};`).join('\n') + '\n  access_log off;');
  [...names].forEach((name, i) => { text = text.replaceAll(`${name}:8080`, `127.0.0.1:${replicas[i].port}`); });
  fs.writeFileSync(path.join(folder, 'nginx.conf'), text);
  const nginx = spawn('nginx', ['-p', folder, '-c', path.join(folder, 'nginx.conf')], { stdio: 'ignore' });
  const ended = new Promise((resolve) => { nginx.on('close', resolve); });
  try {
    const get = (seed) => ask({ port }, 'GET', `/v1/presets/small.glb?seed=${seed}`);
    await until(() => get(0).then((answer) => answer.status === 200, () => false));
    for (let seed = 1; seed < 20; ++seed) assert.equal((await get(seed)).status, 200);
    for (const replica of replicas) assert.ok((await replica.metric('seedmesh_models_total')) > 0, 'both replicas work');
  } finally {
    nginx.kill();
    await ended;
    for (const replica of replicas) await replica.stop();
    fs.rmSync(folder, { recursive: true, force: true });
  }
});

test('every metric of dashboard, alerts, autoscaler and documentation is there', async () => {
  const digest = crypto.createHash('sha256').update('a key').digest('hex');
  const server = await serve(rehearsal, ['--api-keys', `somebody:${digest}`]);
  assert.equal((await server.generate({ generator: 'rehearsal' }, { 'x-api-key': 'a key' })).status, 200);
  const text = (await server.get('/metrics')).text;
  await server.stop();
  const names = new Set([...text.matchAll(/^# TYPE (\S+) (\S+)$/gm)].flatMap(([, name, kind]) => (kind === 'histogram' ? [name, `${name}_bucket`, `${name}_sum`, `${name}_count`] : [name])));
  for (const file of ['grafana/seedmesh.json', 'prometheus/alerts.yaml', 'prometheus/adapter.yaml', 'kubernetes/service/hpa.yaml', '../docs/operating.md']) {
    for (const [name] of read(file).matchAll(/\b(seedmesh|process)_[a-z_]*[a-z](?![a-z_]*\*)\b/g)) {
      assert.ok(names.has(name) || [...names].some((each) => each.startsWith(`${name}_`)), `${file}: ${name}`);
    }
  }
  const queries = JSON.parse(read('grafana/seedmesh.json')).panels.flatMap((panel) => panel.targets.map((target) => target.expr));
  assert.ok(queries.length > 25);
  for (const rule of yaml.parse(read('prometheus/alerts.yaml')).groups[0].rules) assert.ok(rule.alert && rule.expr && rule.annotations.summary);
});
