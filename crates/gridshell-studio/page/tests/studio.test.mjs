// Drives the studio as a person would, in Debian's Chromium.
//
// Wants the command in GRIDSHELL (a path) and Chromium in CHROMIUM or /usr/bin/chromium; fails where one is missing.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { chromium } from "playwright-core";

const command = process.env.GRIDSHELL ?? "";
const browserPath = process.env.CHROMIUM ?? "/usr/bin/chromium";
const PATIENCE = { timeout: 120_000 };

let server;
let address;
let browser;
const folder = mkdtempSync(join(tmpdir(), "studio-"));
const errors = [];

before(async () => {
  assert.ok(existsSync(command), `GRIDSHELL names no command: "${command}"`);
  assert.ok(
    existsSync(browserPath),
    `there is no Chromium at ${browserPath}: apt-get install chromium, or set CHROMIUM`,
  );
  const page = process.env.STUDIO_PAGE ? ["--page", process.env.STUDIO_PAGE] : [];
  server = spawn(command, ["studio", "hexagon", "--no-browser", ...page]);
  let said = "";
  address = await new Promise((resolve, reject) => {
    server.stdout.on("data", (data) => {
      said += data;
      const found = said.match(/http:\/\/\S+/);
      if (found) resolve(found[0]);
    });
    server.on("exit", () => reject(new Error("the studio ended")));
  });
  browser = await chromium.launch({
    executablePath: browserPath,
    args: [
      "--no-sandbox",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--ignore-gpu-blocklist",
    ],
  });
});

after(async () => {
  await browser?.close();
  server?.removeAllListeners("exit");
  server?.kill();
  assert.deepEqual(errors, [], "errors in the page");
});

async function open() {
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  page.on("pageerror", (error) => errors.push(String(error)));
  await page.goto(address);
  await page.waitForSelector("#generate:enabled", PATIENCE);
  await page.waitForFunction(() => document.querySelector(".about dl dd"), null, PATIENCE);
  return page;
}

const seen = (page) => page.evaluate(() => window.studio.seen);

async function choose(page, name) {
  await page.selectOption("#surface", name);
  await page.waitForFunction((n) => document.title.startsWith(n), name, PATIENCE);
}

async function generate(page, values) {
  const before = (await seen(page)).runs.at(-1)?.run ?? 0;
  for (const [key, value] of Object.entries(values)) {
    const field = page.locator(`[id="field-${key}"]`);
    if ((await field.evaluate((f) => f.tagName)) === "SELECT") await field.selectOption(value);
    else await field.fill(value);
  }
  await page.click("#generate");
  return before;
}

async function finished(page, before) {
  await page.waitForFunction((b) => (window.studio.seen.runs.at(-1)?.run ?? 0) > b, before, PATIENCE);
  await page.waitForSelector("#generate:enabled", PATIENCE);
  await page.waitForSelector(".headline", PATIENCE);
}

/** How many different colors the middle of the view has. */
async function colors(page) {
  const shot = await page.locator(".host canvas").first().screenshot();
  return page.evaluate(
    async (bytes) => {
      const bitmap = await createImageBitmap(new Blob([new Uint8Array(bytes)]));
      const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
      const context = canvas.getContext("2d");
      context.drawImage(bitmap, 0, 0);
      const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
      const kinds = new Set();
      for (let k = 0; k < data.length; k += 4)
        kinds.add((data[k] >> 4) * 256 + (data[k + 1] >> 4) * 16 + (data[k + 2] >> 4));
      return kinds.size;
    },
    [...shot],
  );
}

test("a built-in surface opens, a grid is laid live, and colored", async () => {
  const page = await open();
  await choose(page, "dome");
  const before = await generate(page, { effort: "draft", edge_length: "1.6", method: "paper" });
  await page.waitForFunction(() => window.studio.seen.liveFrames > 3, null, PATIENCE);
  await finished(page, before);
  const state = await seen(page);
  assert.ok(state.shown > before && state.liveFrames > 3);
  await page.waitForTimeout(500);
  const plain = await colors(page);
  await page.selectOption("#color", "shape");
  await page.waitForSelector(".legend:not([hidden])", PATIENCE);
  await page.waitForTimeout(500);
  assert.ok((await colors(page)) > plain, "coloring shows");
  assert.match(await page.locator(".legend").innerText(), /Panel shape/);
  await page.selectOption("#color", "length");
  await page.waitForFunction(
    () => document.querySelector(".legend")?.textContent?.includes(" m"),
    null,
    PATIENCE,
  );
  await page.close();
});

test("an irregular node is picked, a member flipped, undone and redone; the grid is exported and opened again", async () => {
  const page = await open();
  await choose(page, "hexagon");
  await finished(page, await generate(page, { effort: "draft", edge_length: "0.7", method: "default" }));
  await page.getByRole("button", { name: "Top", exact: true }).click();
  await page.click("#edit");
  const canvas = page.locator(".host canvas").first();
  const box = await canvas.boundingBox();
  const history = () => page.locator(".steps.history li.done").count();
  // Members inside differ in what they allow: try some until one flips.
  const flipped = async () => {
    for (let k = 0; k < 40; k++) {
      const [x, y] = [0.5 + 0.13 * Math.cos(k), 0.5 + 0.13 * Math.sin(1.7 * k)];
      await page.mouse.move(box.x + x * box.width, box.y + y * box.height);
      await page.waitForTimeout(150);
      await page.keyboard.press("f");
      await page.waitForTimeout(250);
      if ((await history()) > 0) return true;
    }
    return false;
  };
  assert.ok(await flipped(), "no member could be flipped");
  assert.equal(await history(), 1);
  const irregular = (await seen(page)).runs.at(-1).irregular;
  assert.ok(irregular > 0, "a flip leaves irregular nodes");
  await page.keyboard.press("Control+z");
  await page.waitForFunction(
    () => document.querySelectorAll(".steps.history li.done").length === 0,
    null,
    PATIENCE,
  );
  await page.keyboard.press("Control+Shift+Z");
  await page.waitForFunction(
    () => document.querySelectorAll(".steps.history li.done").length === 1,
    null,
    PATIENCE,
  );

  const nodes = (await seen(page)).runs.at(-1).nodes;
  const [download] = await Promise.all([
    page.waitForEvent("download", PATIENCE),
    page.selectOption("#export", "obj"),
  ]);
  const file = join(folder, "grid.obj");
  await download.saveAs(file);
  const text = readFileSync(file, "utf8");
  assert.equal(text.split("\n").filter((l) => l.startsWith("v ")).length, nodes);
  await page.setInputFiles("#file", file);
  await page.waitForFunction(() => document.title.startsWith("grid"), null, PATIENCE);
  await page.close();
});

test("a run is cancelled, and goes on when the page is loaded again", async () => {
  const page = await open();
  await choose(page, "saddle");
  const before = await generate(page, { effort: "best", edge_length: "0.8" });
  await page.waitForSelector("#cancel:enabled", PATIENCE);
  await page.reload();
  await page.waitForSelector("#cancel:enabled", PATIENCE);
  await page.waitForFunction(() => window.studio.seen.liveFrames > 0, null, PATIENCE);
  await page.click("#cancel");
  await finished(page, before);
  assert.match(await page.locator(".report").innerText(), /stopped early|draft/);
  await page.close();
});

test("a broken file is refused with a clear message, and all stays as it was", async () => {
  const page = await open();
  await choose(page, "hexagon");
  const file = join(folder, "broken.step");
  writeFileSync(file, "this is no STEP file");
  const data = await page.evaluateHandle(
    ([name, text]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([text], name));
      return transfer;
    },
    ["broken.step", "this is no STEP file"],
  );
  await page.dispatchEvent(".stage", "drop", { dataTransfer: data });
  await page.waitForSelector(".toast.bad:not([hidden])", PATIENCE);
  const message = await page.locator(".toast").innerText();
  assert.match(message, /broken\.step/);
  assert.doesNotMatch(message, /\/tmp/);
  await page.setInputFiles("#file", file);
  await page.waitForSelector(".toast.bad:not([hidden])", PATIENCE);
  assert.match(await page.title(), /^hexagon/);
  await page.close();
});

test("two tabs see the same desk", async () => {
  const [one, two] = [await open(), await open()];
  await choose(one, "hexagon");
  await two.waitForFunction(() => document.title.startsWith("hexagon"), null, PATIENCE);
  const before = await generate(one, { effort: "draft", edge_length: "0.9" });
  await finished(one, before);
  await finished(two, before);
  assert.equal((await seen(one)).shown, (await seen(two)).shown);
  await one.close();
  await two.close();
});

test("the page works with the keyboard and at its least size", async () => {
  const page = await open();
  await page.keyboard.press("Tab");
  const names = [];
  for (let k = 0; k < 12; k++) {
    names.push(
      await page.evaluate(() => document.activeElement?.id || document.activeElement?.textContent || ""),
    );
    await page.keyboard.press("Tab");
  }
  assert.ok(names.includes("surface") && names.some((n) => n.startsWith("field-")), names.join(", "));
  const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  assert.ok(over <= 0, "nothing sticks out at 1280 x 720");
  await page.close();
});
