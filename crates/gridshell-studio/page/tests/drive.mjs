// What the page's tests share: a studio that runs, a browser, and what a person does in it.
//
// Wants the command in GRIDSHELL (a path) and Chromium in CHROMIUM or /usr/bin/chromium; fails where one is missing.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before } from "node:test";
import { chromium } from "playwright-core";

const command = process.env.GRIDSHELL ?? "";
const browserPath = process.env.CHROMIUM ?? "/usr/bin/chromium";
export const PATIENCE = { timeout: 120_000 };

/** A folder of the test's own. */
export const folder = mkdtempSync(join(tmpdir(), "studio-"));

/** Start a studio with these arguments; its process and address. */
export async function start(...args) {
  assert.ok(existsSync(command), `GRIDSHELL names no command: "${command}"`);
  const page = process.env.STUDIO_PAGE ? ["--page", process.env.STUDIO_PAGE] : [];
  const server = spawn(command, ["studio", "--no-browser", ...page, ...args]);
  let said = "";
  const address = await new Promise((resolve, reject) => {
    server.stdout.on("data", (data) => {
      said += data;
      const found = said.match(/http:\/\/\S+/);
      if (found) resolve(found[0]);
    });
    server.on("exit", () => reject(new Error("the studio ended")));
  });
  return { server, address };
}

/** Stop a studio as a crash would. */
export async function kill({ server }) {
  server.removeAllListeners("exit");
  const gone = new Promise((resolve) => server.on("exit", resolve));
  server.kill("SIGKILL");
  await gone;
}

export function browse() {
  assert.ok(
    existsSync(browserPath),
    `there is no Chromium at ${browserPath}: apt-get install chromium, or set CHROMIUM`,
  );
  return chromium.launch({
    executablePath: browserPath,
    args: [
      "--no-sandbox",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--ignore-gpu-blocklist",
    ],
  });
}

/** A tab at `address`, in a browser that lets pages download only; faults of the page go to `errors`. */
export async function open(browser, address, errors) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  await page.addInitScript(() => delete window.showSaveFilePicker);
  return visit(page, address, errors);
}

/** Go there, and wait until it is ready. */
export async function visit(page, address, errors) {
  page.on("pageerror", (error) => errors.push(String(error)));
  await page.goto(address);
  await page.waitForSelector("#generate:enabled", PATIENCE);
  await page.waitForFunction(() => document.querySelector(".about dl dd"), null, PATIENCE);
  return page;
}

/** One studio and one browser for all tests of a file, which fail where the page has faults; opens a tab. */
export function staged(...args) {
  let studio;
  let browser;
  const errors = [];
  before(async () => {
    studio = await start(...args);
    browser = await browse();
  });
  after(async () => {
    await browser?.close();
    await kill(studio);
    assert.deepEqual(errors, [], "errors in the page");
  });
  return () => open(browser, studio.address, errors);
}

export const seen = (page) => page.evaluate(() => window.studio.seen);

export async function choose(page, name) {
  await page.selectOption("#surface", name);
  await page.waitForFunction((n) => document.title.startsWith(n), name, PATIENCE);
}

export async function generate(page, values) {
  const before = (await seen(page)).runs.at(-1)?.run ?? 0;
  for (const [key, value] of Object.entries(values)) {
    const field = page.locator(`[id="field-${key}"]`);
    if ((await field.evaluate((f) => f.tagName)) === "SELECT") await field.selectOption(value);
    else await field.fill(value);
  }
  await page.click("#generate");
  return before;
}

export async function finished(page, before) {
  await page.waitForFunction((b) => (window.studio.seen.runs.at(-1)?.run ?? 0) > b, before, PATIENCE);
  await page.waitForSelector("#generate:enabled", PATIENCE);
  await page.waitForSelector(".headline", PATIENCE);
}

/** Save what is downloaded when `act` is done; the path. */
export async function downloaded(page, name, act) {
  const [download] = await Promise.all([page.waitForEvent("download", PATIENCE), act()]);
  const path = join(folder, name);
  await download.saveAs(path);
  return path;
}

/** Save the shown grid by the keys, and say that it is there; the path. */
export async function saved(page, name) {
  const path = await downloaded(page, name, () => page.keyboard.press("Control+s"));
  await page.getByRole("button", { name: "It is there" }).click();
  return path;
}

/** Point at members in the middle of the view and press `key` until so many edits are done. */
export async function editing(page, key, wanted = 1) {
  const box = await page.locator(".host canvas").first().boundingBox();
  const history = () => page.locator(".steps.history li.done").count();
  for (let k = 0; k < 80 && (await history()) < wanted; k++) {
    const [x, y] = [0.5 + 0.13 * Math.cos(k), 0.5 + 0.13 * Math.sin(1.7 * k)];
    await page.mouse.move(box.x + x * box.width, box.y + y * box.height);
    await page.waitForTimeout(150);
    await page.keyboard.press(key);
    await page.waitForTimeout(250);
  }
  assert.ok((await history()) >= wanted, `no ${wanted} edits by ${key}`);
}
