// Headless Chromium without a graphics card. Its software renderer draws WebGL 2.
import { chromium } from 'playwright-core';

const flags = [
  '--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
  '--disable-sync', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
];

export const launch = () =>
  chromium.launch({ executablePath: process.env.SEEDMESH_CHROMIUM ?? '/usr/bin/chromium', args: flags });

/** Waits for the page to be in one of the states that it writes on its body; never for a time. */
export const until_state = (page, ...states) =>
  page.waitForFunction((wanted) => wanted.includes(document.body.dataset.state), states, { timeout: 90_000, polling: 100 });

/** Does something that makes the page show another model, and waits until that one is drawn. */
export async function until_shown(page, act) {
  const before = await page.evaluate(() => Number(document.body.dataset.shown));
  await act();
  await page.waitForFunction(
    (count) => Number(document.body.dataset.shown) > count && document.body.dataset.state === 'ready', before, { timeout: 90_000, polling: 100 });
}
