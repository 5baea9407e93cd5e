// The page of `fastball view` in a headless Chromium: a live run started from the page, a connection that is lost and comes back,
// a log, keys, light and dark, two sizes. Nothing may appear in the console but what is expected when the server goes.
//   node view_page_test.mjs PROGRAMS PAGE_SOURCE CHROMIUM FOLDER    (pictures and the log go to FOLDER)
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { existsSync, mkdirSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const [programs, pageSource, chromiumPath, folder] = process.argv.slice(2);

/** Ends with the status by which ctest knows a test that could not be made. */
function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}
if (!existsSync(chromiumPath)) skip('there is no Chromium; apt-get install chromium');
if (
  !existsSync(join(programs, 'view-page/index.html')) ||
  !existsSync(join(pageSource, 'node_modules/playwright-core'))
)
  skip('the page has not been built; ninja view_page');
const { chromium } = createRequire(join(pageSource, 'package.json'))('playwright-core');
const patience = 60_000; // ms, a loaded machine
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const log = join(folder, 'page_test.lcmlog');

/** Starts `fastball view`; resolves when it serves. */
function view(...args) {
  const child = spawn(join(programs, 'fastball'), ['view', '--no-browser', ...args], {
    cwd: folder,
  });
  const ended = new Promise((resolve) => child.on('exit', resolve));
  return new Promise((resolve, reject) => {
    let said = '';
    const hear = (bytes) => {
      said += bytes;
      const url = said.match(/http:\/\/\S+/);
      if (url) resolve({ url: url[0], stop: () => (child.kill('SIGINT'), ended) });
    };
    child.stdout.on('data', hear);
    child.stderr.on('data', hear);
    ended.then((status) => reject(new Error(`fastball view ended with ${status}: ${said}`)));
  });
}

const browser = await chromium.launch({
  executablePath: chromiumPath,
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});
const faults = [];
let lost = false; // the server is away on purpose

async function open(url, { width = 1280, height = 800, scheme = 'light' } = {}) {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme: scheme });
  page.setDefaultTimeout(patience);
  page.on('pageerror', (error) => faults.push(error.message));
  page.on('console', (message) => {
    const expected =
      lost &&
      /ERR_CONNECTION|WebSocket|Failed to load resource|Failed to fetch/.test(message.text());
    if (['error', 'warning'].includes(message.type()) && !expected) faults.push(message.text());
  });
  await page.goto(url);
  return page;
}

const state = (page, wanted) => page.waitForSelector(`#connection[data-state="${wanted}"]`);
const row = (page, words) => page.locator('#throw-rows tr', { hasText: words }).first().waitFor();
const count = (page, what, wanted) =>
  page.waitForFunction(
    ([selector, number]) => document.querySelectorAll(selector).length === number,
    [what, wanted],
  );
const time = async (page) => parseFloat(await page.locator('#time').textContent());
/** How many dots of the 3-D view differ from their left neighbour. */
async function drawn(page) {
  const png = (await page.locator('#scene').screenshot()).toString('base64');
  return page.evaluate(async (bytes) => {
    const image = new Image();
    image.src = `data:image/png;base64,${bytes}`;
    await image.decode();
    const copy = new OffscreenCanvas(image.width, image.height).getContext('2d');
    copy.drawImage(image, 0, 0);
    const { data } = copy.getImageData(0, 0, image.width, image.height);
    let edges = 0;
    for (let i = 4; i < data.length; i += 4) if (Math.abs(data[i] - data[i - 4]) > 8) ++edges;
    return edges;
  }, png);
}
/** Nothing but the lists scrolls, and nothing is cut off at the right. */
const fits = (page) =>
  page.evaluate(() => {
    const { scrollWidth, scrollHeight, clientWidth, clientHeight } = document.documentElement;
    const cut = [...document.querySelectorAll('main *, header *, footer *')]
      .filter((part) => part.getBoundingClientRect().right > clientWidth + 1)
      .map((part) => part.id || part.className || part.tagName);
    return { scrolls: scrollWidth > clientWidth || scrollHeight > clientHeight, cut };
  });

const tests = {
  async 'a throw started from the page is shown live'() {
    const server = await view('--port', '0');
    const page = await open(server.url);
    await state(page, 'quiet');
    assert.match(await page.locator('#notices').innerText(), /No experiment is heard/);
    await page.screenshot({ path: join(folder, 'quiet.png') });
    await page.click('#order-throw');
    await state(page, 'live');
    await page.waitForFunction(() =>
      /^Throw 1/.test(document.querySelector('#reading').textContent),
    );
    await page.screenshot({ path: join(folder, 'live.png') });
    await row(page, 'in ring');
    await count(page, '#process-rows tr', 7);
    await count(page, '.camera canvas:not([hidden])', 2);
    await count(page, '#target .region', 1);

    // A second viewer sees what was before it came.
    const other = await open(server.url, { scheme: 'dark' });
    await row(other, 'in ring');

    // The server goes and comes back on its port; the page finds it by itself.
    lost = true;
    await server.stop();
    await state(page, 'lost');
    await page.screenshot({ path: join(folder, 'lost.png') });
    const again = await view('--port', new URL(server.url).port);
    await state(page, 'quiet');
    lost = false;
    await other.close();
    await page.close();
    await again.stop();
  },

  async 'a run is stopped, is refused beside another, and ends with the viewer'() {
    const server = await view('--port', '0');
    const page = await open(server.url);
    await state(page, 'quiet');
    await page.fill('#order-throws', '20');
    await page.click('#order-throw');
    await state(page, 'live');
    await page.click('#order-stop');
    await page.waitForSelector('#order-throw:enabled');
    await page.waitForFunction(() => /interrupted/.test(document.querySelector('#notices').innerText));
    await state(page, 'quiet');

    const other = spawn(
      join(programs, 'fastball'),
      ['run', '--throws', '20', '--log', join(folder, 'other.lcmlog')],
      { stdio: 'ignore' },
    );
    const ended = new Promise((resolve) => other.on('exit', resolve));
    await state(page, 'live');
    await page.click('#order-throw');
    await page.waitForFunction(() =>
      /another run|already/.test(document.querySelector('#notices').innerText),
    );
    await state(page, 'live');
    other.kill('SIGINT');
    await ended;
    await state(page, 'quiet');

    await page.click('#order-throw');
    await state(page, 'live');
    lost = true;
    await server.stop();
    const again = await view('--port', new URL(server.url).port);
    await state(page, 'quiet');
    lost = false;
    await page.waitForTimeout(2500); // more than the time between two HEARTBEATs
    await state(page, 'quiet');
    await page.close();
    await again.stop();
  },

  async 'a log is played, paused, stepped and searched'() {
    execFileSync(
      join(programs, 'fastball'),
      ['run', '--throws', '2', '--seed', '3', '--log', log],
      { stdio: 'ignore' },
    );
    const server = await view(log, '--port', '0');
    const page = await open(server.url, { scheme: 'dark' });
    await state(page, 'log');
    await page.waitForFunction(() => Number(document.querySelector('#slider').value) > 0.5);
    await page.keyboard.press(' ');
    const paused = await time(page);
    await page.waitForTimeout(300);
    assert.equal(await time(page), paused);
    await page.keyboard.press('ArrowRight');
    await page.waitForFunction(
      (t) => parseFloat(document.querySelector('#time').textContent) > t,
      paused,
    );
    assert.ok(Math.abs((await time(page)) - paused - 0.005) < 0.002);
    await page.keyboard.press('End');
    await row(page, 'in ring');
    await count(page, '#throw-rows tr:not([hidden])', 2);
    await page.keyboard.press('Home');
    await page.waitForFunction(
      () => document.querySelectorAll('#throw-rows tr:not([hidden])').length < 2,
    );
    await page.keyboard.press('End');
    await page.getByRole('button', { name: 'Go to throw 1' }).click();
    await page.waitForFunction(() =>
      /^Throw 1−0\.4/.test(document.querySelector('#reading').textContent),
    );
    for (let i = 0; i < 6; ++i) await page.keyboard.press('Shift+ArrowRight');
    await page.waitForFunction(() =>
      /ball measured/.test(document.querySelector('#reading').textContent),
    );
    await page.waitForFunction(
      () => document.querySelectorAll('.camera:not(.stale) canvas:not([hidden])').length === 2,
    );
    await page.waitForTimeout(500);
    await page.screenshot({ path: join(folder, 'log_dark.png') });
    const edges = await drawn(page);
    assert.ok(edges > 3000, `the 3-D view is empty: ${edges} edges`);
    assert.deepEqual(await fits(page), { scrolls: false, cut: [] });
    for (const key of ['2', '3', '4']) {
      await page.keyboard.press(key);
      await page.waitForTimeout(200);
      await page.screenshot({ path: join(folder, `view_${key}.png`) });
    }
    await page.emulateMedia({ colorScheme: 'light' });
    await page.setViewportSize({ width: 1920, height: 1080 });
    await page.keyboard.press('1');
    await page.waitForTimeout(500);
    assert.deepEqual(await fits(page), { scrolls: false, cut: [] });
    await page.screenshot({ path: join(folder, 'log_light.png') });
    await page.close();
    await server.stop();
  },

  async 'every control is reached by the Tab key and shows it'() {
    const server = await view(log, '--port', '0');
    const page = await open(server.url);
    await state(page, 'log');
    await page.keyboard.press('End');
    await row(page, 'in ring');
    const reached = new Set();
    for (let i = 0; i < 40; ++i) {
      await page.keyboard.press('Tab');
      const focus = await page.evaluate(() => {
        const element = document.activeElement;
        const visible = getComputedStyle(element).outlineStyle !== 'none';
        const name = element.id || element.dataset.view || element.getAttribute('aria-label') || '';
        return visible || element === document.body ? name : `unseen ${name}`;
      });
      reached.add(focus);
    }
    for (const name of ['scene', 'side', 'hand', 'Go to throw 1', 'play', 'slider', 'speed'])
      assert.ok(reached.has(name), `Tab does not reach ${name}: ${[...reached]}`);
    assert.ok(![...reached].some((name) => name.startsWith('unseen')), [...reached].join());
    await page.close();
    await server.stop();
  },

  async 'a log without channels says what is not shown'() {
    const part = join(folder, 'part.lcmlog');
    execFileSync('rm', ['-f', part]);
    execFileSync(join(programs, 'fastball'), [
      'log',
      'cut',
      log,
      '-o',
      part,
      '--exclude',
      'HAND_.*|CAMERA_.*|BALL_.*',
    ]);
    const server = await view(part, '--port', '0');
    const page = await open(server.url);
    await page.waitForFunction(() =>
      /no HAND_STATE[^]*no images[^]*no BALL_TRACK/.test(
        document.querySelector('#notices').innerText,
      ),
    );
    await page.keyboard.press('End');
    await row(page, 'in ring');
    await page.waitForTimeout(300);
    await page.screenshot({ path: join(folder, 'part.png') });
    await page.close();
    await server.stop();
  },
};

let failed = 0;
const only = process.env.ONLY;
for (const [name, test] of Object.entries(tests)) {
  if (only && !name.includes(only)) continue;
  try {
    await test();
    assert.deepEqual(faults.splice(0), [], 'the console has errors');
    console.log(`ok      ${name}`);
  } catch (error) {
    ++failed;
    console.log(`FAILED  ${name}\n${error.stack}`);
  }
}
await browser.close();
console.log(`${Object.keys(tests).length - failed} passed, ${failed} failed`);
process.exit(failed === 0 ? 0 : 1);
