// The form depends on JSON Schema and the x- keywords but on no generator, so most of these tests use an
// invented generator.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { code, field, fragment_of, launch, open, open_parameters, program, request_of, selected, serve, small_tree, until_shown, until_state, write } from './support.mjs';

let server, browser;
before(async () => { server = await serve(program); browser = await launch(); });
after(async () => { await browser?.close(); await server?.stop(); });

const root = path.resolve(import.meta.dirname, '../..');

const kiln_schema = {
  title: 'Kiln', type: 'object', description: 'A made-up generator.',
  properties: {
    heat: { title: 'Heat', description: 'How hot it gets.', type: 'number', minimum: 0, maximum: 40, default: 20, 'x-unit': '°C', 'x-step': 0.5, 'x-group': 'Fire' },
    bricks: { type: 'integer', minimum: 1, maximum: 12, default: 4, 'x-group': 'Fire' },
    vast: { type: 'number', minimum: 0, maximum: 1000000, default: 2, 'x-group': 'Fire' },
    lid: { title: 'Lid', type: 'boolean', default: false, 'x-group': 'Fire' },
    wood: { title: 'Wood', type: 'string', enum: ['dry_oak', 'pine'], default: 'pine', 'x-group': 'Fire' },
    draught: { title: 'Draught', type: 'number', minimum: 1, maximum: 9, 'x-step': 0.1, 'x-group': 'Fire' },
    ash: { title: 'Ash', type: 'number', minimum: 0, maximum: 1000, 'x-step': 0.5, 'x-full': 'heat', 'x-widget': 'growth', 'x-group': 'Fire' },
    flame: { title: 'Flame', type: 'string', enum: ['low', 'high'], 'x-group': 'Fire' },
    slip: { title: 'Slip', type: 'string', 'x-widget': 'color', 'x-group': 'Clay' },
    glaze: { title: 'Glaze', type: 'string', 'x-widget': 'color', default: '#112233', 'x-group': 'Clay' },
    label: { title: 'Label', type: 'string', default: '', 'x-group': 'Clay' },
    marks: { title: 'Marks', type: 'array', items: { type: 'string' }, default: [], 'x-group': 'Clay' },
    script: { title: 'Script', type: 'string', 'x-grammar': 'cga', default: '', 'x-group': 'Clay' },
    names: { title: 'Names', type: 'object', default: {}, additionalProperties: { title: 'Name', oneOf: [{ type: 'number' }, { type: 'string' }] }, 'x-group': 'Clay' },
    tilt: {
      title: 'Tilt', default: 5, 'x-short': ['left', 'right'], 'x-group': 'Clay',
      oneOf: [{ type: 'number', minimum: 0, maximum: 90 }, { type: 'object', properties: { left: { type: 'number', default: 5 }, right: { type: 'number', default: 5 } } }],
    },
    pots: { title: 'Pots', type: 'array', default: [], items: { title: 'Pot', type: 'object', required: ['size'], properties: { size: { title: 'Size', type: 'number', default: 3 } } }, 'x-group': 'Clay' },
    pull: { title: 'Pull', type: 'array', minItems: 3, maxItems: 3, items: { type: 'number' }, default: [0, -1, 0], 'x-unit': 'm', 'x-group': 'Clay' },
    glazes: { title: 'Glazes', type: 'array', items: { type: 'string', 'x-widget': 'color' }, default: ['#ff0000', '#00ff00'], 'x-group': 'Clay' },
    print: { title: 'Print', type: 'string', 'x-widget': 'image', 'x-group': 'Clay' },
    inset: { title: 'Inset', type: 'object', 'x-widget': 'request', properties: { preset: { type: 'string' }, seed: { type: 'integer' } }, 'x-group': 'Clay' },
    shelf: {
      title: 'Shelf', type: 'array', 'x-widget': 'placement', default: [], 'x-group': 'Clay',
      items: { title: 'Pot', type: 'object', required: ['spot'], properties: { spot: { title: 'Spot', type: 'array', minItems: 2, maxItems: 2, items: { type: 'number' }, 'x-unit': 'm' }, years: { title: 'Years', type: 'number', default: 1 } } },
    },
    odd: { title: 'Odd', 'x-group': 'Clay', 'x-advanced': true },
  },
};

/** The page with the made-up generator; `asked()` is the last request that it sent to the server. */
async function open_kiln(parameters = {}) {
  let last = null;
  const page = await open(browser, `${server.url}/${fragment_of({ generator: 'kiln', seed: 1, parameters })}`, {
    before: async (page) => {
      await page.route('**/v1/presets', async (route) => {
        const response = await route.fetch();
        const offer = await response.json();
        await route.fulfill({ response, json: { ...offer, generators: [...offer.generators, { name: 'kiln', title: 'Kiln' }] } });
      });
      await page.route('**/v1/schemas/kiln', (route) => route.fulfill({ json: kiln_schema }));
      await page.route('**/v1/generate', async (route) => {
        last = JSON.parse(route.request().postData());
        await route.continue({ postData: JSON.stringify(small_tree) });
      });
    },
  });
  await open_parameters(page);
  const sends = async (act) => { await until_shown(page, act); return last.parameters; };
  return { page, sends, at: (name) => field(page, `/parameters/${name}`) };
}

test('every kind of value has its control, in groups, with unit, range and help', { timeout: 300_000 }, async () => {
  const { page, at } = await open_kiln();
  assert.deepEqual(await page.locator('#parameters h3').allTextContents(), ['Fire', 'Clay', 'Output']);
  const slider = at('heat').locator('input[type=range]');
  assert.deepEqual(await slider.evaluate((each) => [each.min, each.max, each.step, each.value]), ['0', '40', '0.5', '20']);
  assert.equal(await at('heat').locator('.unit').textContent(), '°C');
  assert.equal(await at('heat').locator('input[type=number]').inputValue(), '20');
  assert.equal(await at('bricks').locator('input[type=range]').getAttribute('step'), '1');
  assert.ok(Number(await at('vast').locator('input[type=range]').getAttribute('max')) <= 10, 'a vast range is cut to where the value is');
  assert.ok(await at('heat').locator('.help').isHidden());
  await at('heat').getByRole('button', { name: 'About Heat' }).click();
  assert.equal(await at('heat').locator('.help').textContent(), 'How hot it gets.');
  assert.ok(await at('heat').locator('.help').isVisible());
  assert.deepEqual(await at('wood').locator('option').allTextContents(), ['dry oak', 'pine']);
  assert.equal(await at('glaze').locator('input[type=color]').inputValue(), '#112233');
  assert.ok(await at('odd').isHidden(), 'what is advanced is folded away');
  assert.deepEqual(page.errors, []);
});

test('an omitted value is shown as such, with the value that applies instead', { timeout: 300_000 }, async () => {
  const { page, sends, at } = await open_kiln({ wood: 'ivory' });
  const ash = at('ash');
  assert.deepEqual(await ash.locator('input[type=range]').evaluate((each) => [each.min, each.max, each.value]), ['0', '20', '20']);
  assert.deepEqual(await ash.locator('input[type=number]').evaluate((each) => [each.value, each.placeholder]), ['', '20']);
  assert.equal((await sends(() => ash.locator('input[type=range]').press('ArrowLeft'))).ash, 19.5);
  assert.ok(await ash.getByRole('button', { name: 'Grow by Ash' }).isVisible());
  const draught = at('draught').locator('input[type=range]');
  assert.deepEqual(await draught.evaluate((slider) => [slider.className, slider.ariaValueText]), ['unset', 'not set'], 'no place is passed off as the value');
  assert.equal(await at('draught').locator('input[type=number]').getAttribute('placeholder'), 'not set');
  assert.equal((await sends(() => draught.press('ArrowRight'))).draught, 1.1);
  assert.equal(await draught.getAttribute('class'), '');
  const flame = at('flame').locator('select');
  assert.equal(await flame.locator('option:checked').textContent(), 'not set');
  assert.equal((await sends(() => flame.selectOption({ label: 'low' }))).flame, 'low');
  assert.ok(!('flame' in await sends(() => flame.selectOption({ label: 'not set' }))));
  assert.equal(await at('wood').locator('option:checked').textContent(), 'ivory: not known');
  assert.equal(await at('slip').locator('input[type=text]').inputValue(), '');
  assert.deepEqual(page.errors, []);
});

test('a change is sent with the type that the schema requires', { timeout: 300_000 }, async () => {
  const { page, sends, at } = await open_kiln();
  assert.deepEqual(await sends(() => at('heat').locator('input[type=number]').fill('21.5')), { heat: 21.5 });
  assert.equal(await at('heat').locator('input[type=range]').inputValue(), '21.5');
  assert.equal((await sends(() => at('lid').locator('input').check())).lid, true);
  assert.equal((await sends(() => at('wood').locator('select').selectOption({ label: 'dry oak' }))).wood, 'dry_oak');
  assert.equal((await sends(() => at('glaze').locator('input[type=text]').fill('#abcdef'))).glaze, '#abcdef');
  assert.equal((await sends(() => at('label').locator('input').fill('a b'))).label, 'a b');
  assert.deepEqual((await sends(() => at('marks').locator('textarea').fill('one\n\n  two'))).marks, ['one', 'two']);
  assert.equal((await sends(() => write(at('script'), 'a\nb'))).script, 'a\nb');
  await at('heat').locator('input[type=number]').fill('');
  await at('heat').locator('input[type=number]').blur();
  assert.equal(await at('heat').locator('input[type=number]').inputValue(), '21.5', 'an emptied box says nothing');
  assert.deepEqual(page.errors, []);
});

test('maps, lists and values with two forms can be edited and reset', { timeout: 300_000 }, async () => {
  const { sends, at } = await open_kiln({ names: { k: 1 }, tilt: 7 });
  assert.deepEqual((await sends(() => at('names/k').locator('input').fill('2 * 3'))).names, { k: '2 * 3' });
  assert.deepEqual((await sends(() => at('names/k').locator('input').fill('6'))).names, { k: 6 });
  assert.deepEqual((await sends(() => at('names').getByRole('button', { name: 'Add name' }).click())).names, { k: 6, c2: 1 });
  assert.deepEqual((await sends(() => at('names').getByRole('button', { name: 'Remove k' }).click())).names, { c2: 1 });
  assert.deepEqual((await sends(() => at('tilt').getByRole('combobox').selectOption({ label: 'In detail' }))).tilt, { left: 7, right: 7 });
  assert.deepEqual((await sends(() => at('tilt/right').locator('input[type=number]').fill('9'))).tilt, { left: 7, right: 9 });
  assert.equal((await sends(() => at('tilt').getByRole('button', { name: 'Reset Tilt' }).click())).tilt, 7);
  assert.equal(await at('tilt').locator('input[type=number]').inputValue(), '7');
  assert.deepEqual((await sends(() => at('pots').getByRole('button', { name: 'Add pot' }).click())).pots, [{ size: 3 }]);
  await at('pots').locator('summary').click();
  assert.deepEqual((await sends(() => at('pots/0/size').locator('input[type=number]').fill('4'))).pots, [{ size: 4 }]);
  assert.deepEqual((await sends(() => at('pots').getByRole('button', { name: 'Remove Pot 0' }).click())).pots, []);
});

test('vectors, colours, images and nested requests have their own fields', { timeout: 300_000 }, async () => {
  const { page, sends, at } = await open_kiln();
  assert.deepEqual(await at('pull').locator('input').evaluateAll((each) => each.map((input) => input.getAttribute('aria-label'))), ['Pull, x', 'Pull, y', 'Pull, z']);
  assert.deepEqual(await at('pull').locator('.axis, .unit').allTextContents(), ['x', 'm', 'y', 'm', 'z', 'm']);
  assert.deepEqual((await sends(() => at('pull').getByLabel('Pull, y').fill('2.5'))).pull, [0, 2.5, 0]);
  assert.ok(!('pull' in (await sends(() => at('pull').getByRole('button', { name: 'Reset Pull' }).click()))));
  assert.deepEqual((await sends(() => at('glazes').getByLabel('Glazes 2', { exact: true }).fill('#0000ff'))).glazes, ['#ff0000', '#0000ff']);
  assert.deepEqual((await sends(() => at('glazes').getByRole('button', { name: 'Remove Glazes 1' }).click())).glazes, ['#0000ff']);
  assert.deepEqual((await sends(() => at('glazes').getByRole('button', { name: 'Add colour' }).click())).glazes, ['#0000ff', '#0000ff']);
  const png = 'iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==';
  const printed = await sends(() => at('print').locator('.picture-drop').evaluate((area, png) => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([Uint8Array.from(atob(png), (each) => each.charCodeAt(0))], 'dot.png', { type: 'image/png' }));
    area.dispatchEvent(new DragEvent('drop', { dataTransfer, bubbles: true, cancelable: true }));
  }, png));
  assert.equal(printed.print, `data:image/png;base64,${png}`);
  assert.equal(await at('print').locator('img').evaluate(async (each) => { await each.decode(); return each.naturalWidth; }), 1);
  assert.ok(!('print' in (await sends(() => at('print').getByRole('button', { name: 'Remove Print' }).click()))));
  await at('inset').locator('select').scrollIntoViewIfNeeded();
  await at('inset').locator('option[value=koch_snowflake]').waitFor({ state: 'attached' });
  assert.deepEqual((await sends(() => at('inset').locator('select').selectOption('koch_snowflake'))).inset, { preset: 'koch_snowflake' });
  assert.equal(await at('inset').locator('img').getAttribute('src'), './thumbnails/koch_snowflake.webp');
  assert.deepEqual(page.errors, []);
});

test('positions are added, selected, moved and removed in the view', { timeout: 300_000 }, async () => {
  const { page, sends, at } = await open_kiln();
  await page.click('#hint-away');
  const canvas = page.locator('#picture');
  const [first] = (await sends(() => canvas.click({ button: 'right', position: { x: 140, y: 230 } }))).shelf;
  assert.deepEqual(Object.keys(first), ['spot']);
  assert.equal((await sends(() => at('shelf/0/years').locator('input[type=number]').fill('30'))).shelf[0].years, 30);
  await at('shelf').getByRole('button', { name: 'Plant by click' }).click();
  const two = (await sends(() => canvas.click({ position: { x: 300, y: 230 } }))).shelf;
  assert.equal(two.length, 2);
  assert.equal(two[1].years, 30, 'like the one that was chosen');
  assert.ok(two[1].spot[0] > first.spot[0], 'further to the right');
  await at('shelf').getByRole('button', { name: 'Plant by click' }).click();
  // A click selects the nearest position.
  await canvas.click({ position: { x: 140, y: 230 } });
  assert.match(await at('shelf').locator('.chosen').textContent(), /^Pot 1/);
  await at('shelf').getByRole('button', { name: 'Move by click' }).click();
  const moved = (await sends(() => canvas.click({ position: { x: 220, y: 240 } }))).shelf;
  assert.equal(moved.length, 2);
  assert.notDeepEqual(moved[0].spot, first.spot);
  assert.equal((await sends(() => at('shelf').getByRole('button', { name: 'Remove Pot 1' }).click())).shelf.length, 1);
  assert.deepEqual(page.errors, []);
});

test('reset restores the original value of one field', { timeout: 300_000 }, async () => {
  const { sends, at } = await open_kiln({ heat: 30 });
  const reset = at('heat').getByRole('button', { name: 'Reset Heat' });
  assert.ok(await reset.isHidden());
  assert.equal((await sends(() => at('heat').locator('input[type=number]').fill('31'))).heat, 31);
  assert.equal((await sends(() => reset.click())).heat, 30);
  assert.equal((await sends(() => at('lid').locator('input').check())).lid, true);
  assert.ok(!('lid' in (await sends(() => at('lid').getByRole('button', { name: 'Reset Lid' }).click()))));
});

test('all errors are shown at their fields at once, and columns count characters', { timeout: 300_000 }, async () => {
  const broken = { ...small_tree, parameters: { ...small_tree.parameters, productions: ['F -> F', 'Ф -> 🌲 [', 'X -> ('], iterations: -1, sides: 1000 } };
  const page = await open(browser, `${server.url}/${fragment_of(broken)}`, { states: ['refused'] });
  await page.locator('#alert button').click();
  const spots = field(page, '/parameters/productions').locator('.spot');
  await spots.nth(1).waitFor();
  const answer = await server.generate(broken);
  const listed = answer.json.errors.filter((issue) => issue.pointer.startsWith('/parameters/productions/'));
  assert.equal(await spots.count(), listed.length);
  assert.ok(listed.length >= 2);
  for (const [index, issue] of listed.entries()) {
    const line = Number(issue.pointer.split('/').at(-1)) + 1;
    assert.equal(await spots.nth(index).textContent(), `Line ${line}, column ${issue.column}: ${issue.message}`);
  }
  assert.equal(await field(page, '/parameters/iterations').locator('input[type=number]').getAttribute('aria-invalid'), 'true');
  assert.ok((await field(page, '/parameters/sides').locator('.issue').textContent()).length > 0);
  await field(page, '/parameters/productions').locator('.spot', { hasText: 'Line 2' }).first().click();
  assert.equal(await selected(field(page, '/parameters/productions')), '[');
});

test('a single error is reported with the label of its field, several by their number', { timeout: 300_000 }, async () => {
  const wrong = (parameters) => `${server.url}/${fragment_of({ ...small_tree, parameters: { ...small_tree.parameters, ...parameters } })}`;
  const page = await open(browser, wrong({ iterations: -1 }), { states: ['refused'] });
  await open_parameters(page);
  const label = await field(page, '/parameters/iterations').locator('.label').first().textContent();
  await page.waitForFunction((label) => document.getElementById('alert').textContent.startsWith(`${label}: `), label);
  const many = await open(browser, wrong({ iterations: -1, sides: 1000000 }), { states: ['refused'] });
  assert.match(await many.textContent('#alert'), /^This request has 2 errors\./);
  await open_parameters(many);
  assert.match(await field(many, '/parameters/sides').locator('.issue').textContent(), /1,000,000/);
});

test('an error without a field is shown in the alert', { timeout: 300_000 }, async () => {
  const strange = { ...small_tree, parameters: { ...small_tree.parameters, unheard_of: 1 } };
  const page = await open(browser, `${server.url}/${fragment_of(strange)}`, { states: ['refused'] });
  assert.match(await page.textContent('#alert'), /unheard_of/);
});

test('the address stores edits, and Back returns to the previous preset', { timeout: 300_000 }, async () => {
  const page = await open(browser, `${server.url}/`);
  await until_shown(page, () => page.click('[data-preset="koch_snowflake"]'));
  const preset_hash = new URL(page.url()).hash;
  await until_shown(page, () => page.fill('#seed', '77'));
  const title = await page.textContent('#title');
  // The address is updated shortly after the view.
  await page.waitForFunction((hash) => location.hash !== hash, preset_hash);
  assert.equal(request_of(new URL(page.url()).hash).seed, 77);
  await until_shown(page, () => page.click('[data-preset="dragon_curve"]'));
  await until_shown(page, () => page.goBack());
  assert.equal(await page.inputValue('#seed'), '77');
  assert.equal(await page.textContent('#title'), title);
  await page.reload();
  await until_state(page, 'ready');
  assert.equal(await page.inputValue('#seed'), '77');
  assert.equal(await page.textContent('#title'), title);
});

test('the client source contains no parameter name', () => {
  const folder = path.join(root, 'web_client/src');
  const source = fs.readdirSync(folder, { recursive: true }).filter((file) => file.endsWith('.ts'))
    .map((file) => fs.readFileSync(path.join(folder, file), 'utf8')).join('\n');
  const names = new Set();
  const collect = (schema) => {
    for (const [name, member] of Object.entries(schema.properties ?? {})) { names.add(name); collect(member); }
    for (const part of [schema.items, ...(schema.oneOf ?? [])]) if (part) collect(part);
  };
  for (const file of fs.readdirSync(path.join(root, 'api_schema')).filter((name) => name.endsWith('.schema.json'))) {
    if (/^(common|output|problem|request)\./.test(file)) continue;
    collect(JSON.parse(fs.readFileSync(path.join(root, 'api_schema', file), 'utf8')));
  }
  // HTML, three.js and the output use these words too. They count only where the code looks them up among the
  // parameters.
  const common = new Set(['width', 'style', 'step', 'value', 'name', 'color', 'text', 'span', 'role', 'map', 'form', 'start', 'center', 'position', 'direction',
    'grid', 'cell', 'reach', 'low', 'high', 'glb',
    // A DOM event, coordinates, widgets of the schema, a list of the vocabulary.
    'drop', 'x', 'z', 'image', 'attributes', 'functions',
    // An input type, a three.js term, a member of the derive response, a class name.
    'range', 'material', 'shapes', 'pair',
    // Class names and elements of the page.
    'soft', 'shown', 'at', 'near', 'place', 'picture', 'fold',
    // A value that a shader reads, an element and an event of the page.
    'centre', 'detail', 'y',
    // Annotations of CityEngine.
    'order', 'angle', 'length', 'distance',
    // A notation of the editor, an attribute and a class name of elements.
    'expression', 'class', 'colors',
    // A mode of shadow roots and a cause of states, a part of a line of the editor.
    'open', 'condition',
    // A method of elements, and a module of the page.
    'remove', 'words',
    // Members and kinds of the features of a city's plan, and a member of the derive response.
    'type', 'features', 'properties', 'geometry', 'area', 'water', 'block', 'highway', 'sidewalk', 'major', 'heights']);
  assert.ok(names.has('productions'));
  for (const name of names) {
    assert.doesNotMatch(source, new RegExp(`parameters(\\.|\\[['"])${name}\\b`), name);
    if (!common.has(name)) assert.doesNotMatch(source, new RegExp(`['"\`]${name}['"\`]`), name);
  }
});
