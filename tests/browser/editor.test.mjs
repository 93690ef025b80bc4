// The code editor in the form and the JSON editor of the whole request, which edit the same state.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { code, field, fragment_of, launch, open, open_parameters, program, selected, serve, small_tree, statistics, until_shown, until_state, write, written } from './support.mjs';

let server, browser, address;
before(async () => {
  server = await serve(program);
  browser = await launch();
  address = `${server.url}/${fragment_of(small_tree)}`;
});
after(async () => { await browser?.close(); await server?.stop(); });

const productions = (page) => field(page, '/parameters/productions');
const request = (page) => page.locator('#request');
/** The request as it stands in the JSON editor. */
const as_json = async (page) => JSON.parse(await written(request(page)));

async function open_json(page) {
  await page.click('#tab-request');
  await code(request(page)).waitFor();
}

test('the editor chunk is fetched when its first text becomes visible, and not before', { timeout: 200_000 }, async () => {
  const fetched = [];
  const page = await open(browser, address, { before: async (page) => { page.on('request', (each) => fetched.push(each.url())); } });
  assert.ok(!fetched.some((url) => /editor-/.test(url)));
  await open_parameters(page);
  await code(productions(page)).waitFor();
  assert.equal(fetched.filter((url) => /editor-/.test(url)).length, 1);
  assert.equal(await written(productions(page)), small_tree.parameters.productions.join('\n'));
  assert.deepEqual(page.errors, []);
});

test('a text area replaces an editor that cannot be loaded', { timeout: 200_000 }, async () => {
  const page = await open(browser, address, { before: (page) => page.route('**/editor-*.js', (route) => route.abort()) });
  await open_parameters(page);
  const area = productions(page).locator('textarea');
  await until_shown(page, () => area.fill('F -> F[+F]F'));
  await area.fill('F -> F[+F');
  await until_state(page, 'refused');
  assert.match(await productions(page).locator('.spot').first().textContent(), /^Line 1, column 7/);
  assert.equal(await productions(page).locator('mark').first().textContent(), '[');
});

test('symbols, arrows, numbers and functions have different colours', { timeout: 200_000 }, async () => {
  const parametric = { ...small_tree, parameters: { axiom: 'A(1)', productions: ['A(l) : l > 0.1 -> F(l)[+(sin(30)*50)A(l*0.6)] : 0.5', 'A(l) -> F(l) : 0.5'], iterations: 2 } };
  const page = await open(browser, `${server.url}/${fragment_of(parametric)}`);
  await open_parameters(page);
  await code(productions(page)).waitFor();
  const colours = await code(productions(page)).evaluate((content) => Object.fromEntries(
    [...content.querySelectorAll('.cm-line:first-child span')].map((span) => [span.textContent, getComputedStyle(span).color])));
  for (const [one, other] of [['A', 'F'], ['->', 'F'], ['sin', '30'], ['[', 'F'], ['30', 'F']]) {
    assert.ok(colours[one] && colours[other], `${one} and ${other} in ${JSON.stringify(colours)}`);
    assert.notEqual(colours[one], colours[other], `${one} and ${other}`);
  }
});

test('completion offers the words of the vocabulary with their descriptions', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  await open_parameters(page);
  const { turtle, functions } = (await server.get('/v1/vocabulary')).json;
  await code(productions(page)).click();
  await page.keyboard.press('Control+End');
  await page.keyboard.type('F(sq');
  const options = page.locator('.cm-tooltip-autocomplete li');
  await options.first().waitFor();
  assert.match(await options.first().textContent(), /^sqrt/);
  assert.ok(functions.some((each) => each.name === 'sqrt'));
  const info = page.locator('.cm-completionInfo');
  await info.waitFor();
  assert.ok((await info.textContent()).startsWith(functions.find((each) => each.name === 'sqrt').text));
  // Completion ignores keys for a short time after it opens, so that it does not capture keys meant for the
  // text.
  await page.waitForTimeout(150);
  await page.keyboard.press('Enter');
  assert.match(await written(productions(page)), /F\(sqrt\($/);
  await page.keyboard.type('4))');
  await page.keyboard.press('Control+Space');
  await options.first().waitFor();
  assert.ok((await options.count()) > 10);
  assert.ok((await options.allTextContents()).every((text) => turtle.some((each) => text.startsWith(each.symbol))));
});

test('shape grammar rules have their own highlighting, completion and errors', { timeout: 300_000 }, async () => {
  const rules = 'Lot --> extrude(9) comp(f) { side : floor | top : Roof. }\nfloor --> split(\"y\") { ~3 : Band }*\nBand --> color(\"#aa8866\") Wall.';
  const house = { generator: 'building', seed: 1, parameters: { rules, start: 'Lot', size: [8, 0, 6] } };
  const page = await open(browser, `${server.url}/${fragment_of(house)}`);
  await open_parameters(page);
  const text = page.locator('[data-pointer^="/parameters/"]').filter({ has: page.locator('.cm-content') }).first();
  await code(text).waitFor();
  const colours = await code(text).evaluate((content) => [...content.querySelectorAll('.cm-line span')].map((span) => [span.textContent, getComputedStyle(span).color]));
  const of = (word) => colours.find(([text]) => text === word)?.[1];
  for (const [one, other] of [['extrude', 'Lot'], ['extrude', '9'], ['split', 'Band'], ['-->', 'Lot'], ['"y"', 'split']]) {
    assert.ok(of(one) && of(other), `${one} and ${other} in ${JSON.stringify(colours)}`);
    assert.notEqual(of(one), of(other), `${one} and ${other}`);
  }
  const { building_operations: operations, building_materials: materials } = (await server.get('/v1/vocabulary')).json;
  const options = page.locator('.cm-tooltip-autocomplete li');
  const type_at_end = async (words) => { await code(text).click(); await page.keyboard.press('Control+End'); await page.keyboard.type(words); await options.first().waitFor(); };
  await type_at_end('\nRoof --> roofHi');
  assert.match(await options.first().textContent(), /^roofHip/);
  await page.locator('.cm-completionInfo').waitFor();
  assert.ok((await page.textContent('.cm-completionInfo')).startsWith(operations.find((each) => each.name === 'roofHip').text));
  await page.waitForTimeout(150);
  await page.keyboard.press('Enter');
  assert.match(await written(text), /roofHip\($/);
  await page.keyboard.type('30) material("sla');
  await options.first().waitFor();
  assert.deepEqual(await options.allTextContents(), materials.filter((name) => name.includes('sla')));
  await page.waitForTimeout(150);
  await page.keyboard.press('Enter');
  await page.keyboard.press('Escape');
  await until_shown(page, () => page.keyboard.type('") Tiles.'));
  await write(text, rules.replace('extrude(9)', 'extrude(9'));
  await until_state(page, 'refused');
  await text.locator('.cm-lintRange-error').first().waitFor();
  assert.match(await text.locator('.spot').first().textContent(), /^Line 1, column \d+: /);
  await until_shown(page, () => write(text, rules));
  // The text is validated by a separate request, whose answer may arrive after the model.
  await page.waitForFunction(() => document.querySelectorAll('#parameters .spot:not(.mild)').length === 0);
  assert.deepEqual(page.errors, []);
});

test('errors and warnings are underlined at the line and column that the server reports', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  await open_parameters(page);
  await write(productions(page), 'F -> F[+F]\nX -> Y(');
  await until_state(page, 'refused');
  await productions(page).locator('.cm-lintRange-error').waitFor();
  assert.equal(await productions(page).locator('.cm-lintRange-error').first().textContent(), '(');
  await productions(page).locator('.spot').first().click();
  assert.equal(await selected(productions(page)), '(');
  // Weights that do not sum to 1 cause a warning, so there is a model as well as a message.
  await until_shown(page, () => write(productions(page), 'F -> F[+F] : 0.5\nF -> F[-F] : 0.2'));
  await productions(page).locator('.spot.mild').first().waitFor();
  assert.equal(await code(productions(page)).getAttribute('aria-invalid'), 'false');
});

test('validation reports errors even if the model is slow', { timeout: 200_000 }, async () => {
  const page = await open(browser, address, { before: async (page) => { page.held = false; await page.route('**/v1/generate', (route) => (page.held ? undefined : route.continue())); } });
  await open_parameters(page);
  page.held = true;
  await write(productions(page), 'F -> F[');
  await productions(page).locator('.cm-lintRange-error').waitFor();
});

test('changes in the form appear in the JSON and vice versa', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  await open_parameters(page);
  const box = field(page, '/parameters/iterations').locator('input[type=number]');
  await until_shown(page, () => box.fill('2'));
  await open_json(page);
  assert.deepEqual(await as_json(page), { ...small_tree, parameters: { ...small_tree.parameters, iterations: 2 } });
  await until_shown(page, async () => write(request(page), JSON.stringify({ ...small_tree, seed: 9, parameters: { ...small_tree.parameters, iterations: 4 } })));
  assert.equal(await page.inputValue('#seed'), '9');
  await page.click('#tab-parameters');
  assert.equal(await box.inputValue(), '4');
  await until_shown(page, () => page.fill('#seed', '10'));
  await open_json(page);
  assert.equal((await as_json(page)).seed, 10);
});

test('JSON syntax errors and invalid requests are reported at their position', { timeout: 300_000 }, async () => {
  const page = await open(browser, address);
  await open_json(page);
  const before = await statistics(page);
  await write(request(page), '{"generator": "lsystem",\n "seed": 3,, }');
  await page.waitForFunction(() => /line 2, column 12/i.test(document.getElementById('request-error').textContent));
  assert.deepEqual(await statistics(page), before, 'the last model stays');
  await write(request(page), JSON.stringify({ ...small_tree, parameters: { ...small_tree.parameters, sides: 100_000 } }, null, 1));
  await until_state(page, 'refused');
  await request(page).locator('.spot').first().click();
  assert.equal(await selected(request(page)), '100000');
  await until_shown(page, () => write(request(page), '{"preset": "koch_snowflake", "seed": 4}'));
  await page.waitForFunction(() => document.getElementById('seed').value === '4');
});

test('the Tab key leaves the editor', { timeout: 200_000 }, async () => {
  const page = await open(browser, address);
  await open_parameters(page);
  await code(productions(page)).click();
  await page.keyboard.press('Tab');
  assert.ok(await page.evaluate(() => !document.activeElement.closest('.code-editor')));
});
