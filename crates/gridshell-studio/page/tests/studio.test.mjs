// Drives the studio as a person would, in Debian's Chromium.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import * as drive from "./drive.mjs";
import { PATIENCE, choose, downloaded, editing, finished, folder, generate, seen } from "./drive.mjs";

const open = drive.staged("hexagon", "--no-autosave");

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
  const before = await generate(page, { effort: "draft", edge_length: "0.5", method: "paper" });
  // How many pictures arrive depends on the machine: each makes way for the next. That one does is the truth.
  await page.waitForFunction(() => window.studio.seen.liveFrames > 0, null, PATIENCE);
  await finished(page, before);
  const state = await seen(page);
  assert.ok(state.shown > before);
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
  await editing(page, "f");
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

  // One of them is pointed at.
  const box = await page.locator(".host canvas").first().boundingBox();
  const [x, y] = await page.evaluate(() => window.studio.project(window.studio.irregular[0]));
  await page.mouse.move(box.x + x, box.y + y);
  await page.waitForFunction(
    () => window.studio.seen.picked?.facts.some((f) => f.value.includes("irregular")),
    null,
    PATIENCE,
  );
  assert.ok((await seen(page)).picked.node_first);

  const nodes = (await seen(page)).runs.at(-1).nodes;
  const file = await downloaded(page, "grid.obj", () => page.selectOption("#export", "obj"));
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

test("while a run goes on, another grid is edited: suggestions, tips and operations come", async () => {
  const page = await open();
  await choose(page, "hexagon");
  await finished(page, await generate(page, { effort: "draft", edge_length: "0.7" }));
  await page.getByRole("button", { name: "Top", exact: true }).click();
  const mine = (await seen(page)).shown;
  await choose(page, "great-court");
  await generate(page, { effort: "best", edge_length: "0.4" });
  await page.waitForFunction((m) => (window.studio.seen.runs.at(-1)?.run ?? 0) > m, mine, PATIENCE);
  await page.waitForFunction(() => window.studio.seen.liveFrames > 0, null, PATIENCE);
  await page.locator(`[data-run="${mine}"]`).click();
  await page.click("#edit");
  await page.waitForFunction(
    () => !document.querySelector(".steps:not(.history)").textContent.includes("Looking"),
    null,
    PATIENCE,
  );
  await editing(page, "s", 2);
  assert.ok(await page.locator("#cancel").isEnabled(), "the run still goes on");
  await page.click("#cancel");
  await page.waitForSelector("#generate:enabled", PATIENCE);
  await page.close();
});

test("a broken file is refused with a clear message, and all stays as it was", async () => {
  const page = await open();
  await choose(page, "hexagon");
  const file = join(folder, "broken.step");
  writeFileSync(file, "not a STEP file");
  const data = await page.evaluateHandle(
    ([name, text]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([text], name));
      return transfer;
    },
    ["broken.step", "not a STEP file"],
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
  // The keys of the edit mode once ran out of their panel.
  await page.click("#edit");
  const cut = await page.evaluate(() =>
    [...document.querySelectorAll("aside, aside section, .toolbar, .keys")]
      .filter((e) => e.scrollWidth > e.clientWidth)
      .map((e) => e.className),
  );
  assert.deepEqual(cut, [], "nothing is cut off");
  await page.close();
});
