// The attackers of ./dev attack, in a separate process so that they do not delay the measuring client. Usage:
// attackers.mjs <name> <port> <seconds> <preset> <permalink>. Prints the results as JSON.
import crypto from 'node:crypto';
import net from 'node:net';
import zlib from 'node:zlib';

const [name, port_text, seconds_text, preset, permalink] = process.argv.slice(2);
const port = Number(port_text), end = Date.now() + Number(seconds_text) * 1000;
const got = { connections: 0, sent: 0, statuses: {} };
const sleep = (milliseconds) => new Promise((resolve) => { setTimeout(resolve, milliseconds); });
const running = () => Date.now() < end;

function count(text) {
  for (const [, status] of text.matchAll(/HTTP\/1\.1 (\d{3})/g)) got.statuses[status] = (got.statuses[status] ?? 0) + 1;
}

/** One connection: `talk` writes to it; resolves when the server or the end closes it. */
function connect(talk, { read = true } = {}) {
  return new Promise((resolve) => {
    const socket = net.connect({ port, host: '127.0.0.1' });
    const timer = setTimeout(() => socket.destroy(), Math.max(1, end - Date.now()));
    ++got.connections;
    const write = (bytes) => new Promise((written) => {
      if (socket.destroyed || !socket.writable) { written(false); return; }
      got.sent += Buffer.byteLength(bytes);
      socket.write(bytes, (error) => written(!error));
    });
    if (read) socket.on('data', (bytes) => count(bytes.length < 65_536 ? bytes.toString('latin1') : bytes.toString('latin1', 0, 64)));
    socket.on('error', () => {});
    socket.on('end', () => socket.destroy());
    socket.on('close', () => { clearTimeout(timer); resolve(); });
    socket.on('connect', () => { Promise.resolve(talk(write, socket)).catch(() => {}); });
  });
}

/** `number` clients that do the same again and again. */
const parallel = (number, once) => Promise.all(Array.from({ length: number }, async (_, who) => {
  while (running()) { await once(who); await sleep(2); }
}));

const post = (body, fields = '', target = '/v1/generate') => `POST ${target} HTTP/1.1\r\nHost: here\r\nContent-Type: application/json\r\n${fields}Content-Length: ${Buffer.byteLength(body)}\r\n\r\n${body}`;
const get = (target, fields = '') => `GET ${target} HTTP/1.1\r\nHost: here\r\n${fields}\r\n`;
const ask = (text, options) => connect(async (write, socket) => { await write(text); setTimeout(() => socket.end(), 300); }, options);
const token = (text) => zlib.deflateRawSync(text).toString('base64url');
const mebibyte = Buffer.alloc(1 << 20, 'a');

/** Writes the same bytes for as long as the server takes them. */
const flood = (head, bytes, clients = 8) => parallel(clients, () => connect(async (write) => {
  await write(head);
  while (running() && (await write(bytes)));
}));

/** A client that reads 2 KB of a large answer every `pause` milliseconds. Resolves when the server or the end closes it. */
const read_slowly = (text, pause) => new Promise((resolve) => {
  const socket = net.connect({
    port, host: '127.0.0.1',
    onread: { buffer: Buffer.alloc(2048), callback: (size, buffer) => { count(buffer.toString('latin1', 0, 64)); setTimeout(() => socket.resume(), pause); return false; } },
  });
  const timer = setTimeout(() => socket.destroy(), Math.max(1, end - Date.now()));
  ++got.connections;
  got.sent += text.length;
  socket.on('error', () => {});
  socket.on('close', () => { clearTimeout(timer); resolve(); });
  socket.write(text);
});

let seed = 0;
/** A model of about 25 MB that was never asked for. */
const large = () => JSON.stringify({ generator: 'terrain', seed: ++seed, parameters: { algorithm: 'fbm', resolution: 769 } });
const explosion = () => JSON.stringify({ generator: 'lsystem', seed: ++seed, parameters: { axiom: 'A', productions: ['A -> AAAAAAAAAA'], iterations: 1000 } });

const attacks = {
  'idle connections': () => parallel(100, () => connect(() => {})),
  'slow heads': () => parallel(60, () => connect(async (write) => {
    await write('GET / HTTP/1.1\r\nHost: here\r\n');
    while (running() && (await write(`X-${Math.random()}: a\r\n`))) await sleep(400);
  })),
  'slow bodies': () => parallel(40, () => connect(async (write) => {
    await write('POST /v1/generate HTTP/1.1\r\nHost: here\r\nContent-Length: 4000000\r\n\r\n');
    while (running() && (await write('{'))) await sleep(400);
  })),
  'endless fields': () => flood('GET / HTTP/1.1\r\nHost: here\r\n', Buffer.from('X-Filler: aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa\r\n'.repeat(1000))),
  'an endless line': () => flood('GET /', mebibyte),
  'chunked bodies over the limit': () => flood('POST /v1/generate HTTP/1.1\r\nHost: here\r\nTransfer-Encoding: chunked\r\n\r\n', Buffer.concat([Buffer.from('100000\r\n'), mebibyte, Buffer.from('\r\n')])),
  'bodies over the limit': () => flood('POST /v1/generate HTTP/1.1\r\nHost: here\r\nContent-Length: 2000000000\r\n\r\n', mebibyte),
  'compressed bodies': () => {
    const bomb = zlib.gzipSync(Buffer.alloc(50e6, 'a'));
    return parallel(8, () => ask(Buffer.concat([Buffer.from(`POST /v1/generate HTTP/1.1\r\nHost: here\r\nContent-Encoding: gzip\r\nContent-Length: ${bomb.length}\r\n\r\n`), bomb])));
  },
  '1,500 overlapping ranges': () => parallel(8, () => ask(get(permalink, `Range: bytes=${Array.from({ length: 1500 }, (_, i) => `${i}-`).join(',')}\r\n`))),
  'long paths': () => parallel(8, () => ask(get(`/v1/models/${'a/'.repeat(3900)}`) + get(`/${'(a+)+'.repeat(1500)}!`))),
  'requests behind a refused body': () => parallel(8, () => ask(`POST /v1/generate HTTP/1.1\r\nHost: here\r\nContent-Length: 20000000\r\n\r\n${get('/v1/presets').repeat(50)}`)),
  'two lengths, a negative one, a chunk of -2': () => parallel(8, async () => {
    await ask('POST /v1/generate HTTP/1.1\r\nHost: here\r\nContent-Length: 2\r\nContent-Length: 20\r\n\r\n{}');
    await ask('POST /v1/generate HTTP/1.1\r\nHost: here\r\nContent-Length: -2\r\n\r\n{}');
    await ask('POST /v1/generate HTTP/1.1\r\nHost: here\r\nTransfer-Encoding: chunked\r\n\r\n-2\r\n{}\r\n0\r\n\r\n');
  }),
  'paths that climb or end with NUL': () => parallel(8, () => ask(get('/../../etc/passwd') + get('/%2e%2e/%2e%2e/etc/passwd') + get('/index.html%00.png'))),
  'bursts of 400 connects': async () => {
    while (running()) { await Promise.all(Array.from({ length: 400 }, () => ask(get('/healthz')))); await sleep(200); }
  },
  'clients that do not read': () => parallel(40, () => connect(async (write) => { await write(get(`/v1/presets/${preset}.glb`).repeat(40)); await sleep(20_000); }, { read: false })),
  'clients that read 2 KB every 10 s': () => parallel(30, () => read_slowly(post(large()), 10_000)),
  'clients that read 2 KB ten times a second': () => parallel(30, () => read_slowly(post(large()), 100)),
  'slow readers of compressed answers': () => parallel(30, () => read_slowly(post(large(), 'Accept-Encoding: gzip, br, zstd\r\n'), 1000)),
  'permalinks that open to much': () => {
    const bomb = token(`{"generator":"lsystem","parameters":{"axiom":"${'F'.repeat(4_000_000)}"}}`);
    return parallel(4, () => ask(get(`/v1/models/${bomb.slice(0, 7900)}.glb`) + get(`/v1/models/${token(`[${'['.repeat(6000)}`)}.glb`)));
  },
  'deep and wide JSON': () => parallel(4, async () => { await ask(post('['.repeat(1e6))); await ask(post(`{"generator":"lsystem","parameters":{"productions":[${'"F->F",'.repeat(2e5)}"F->F"]}}`)); }),
  'grammars that explode': () => parallel(8, () => ask(post(explosion()))),
  'guesses at signatures': () => parallel(8, () => ask(Array.from({ length: 20 }, () => get(`${permalink}?key=a&signature=${crypto.randomBytes(32).toString('base64url')}`)).join(''))),
};

if (name === '--list') console.log(JSON.stringify(Object.keys(attacks)));
else { await attacks[name](); console.log(JSON.stringify(got)); process.exit(0); }
