// What a person has made is not lost: saved and opened again, kept against crashes.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import * as drive from "./drive.mjs";
import { PATIENCE, choose, editing, finished, folder, generate, saved as save, seen } from "./drive.mjs";

let browser;
const errors = [];
before(async () => {
  browser = await drive.browse();
});
after(async () => {
  await browser?.close();
  assert.deepEqual(errors, [], "errors in the page");
});

const nodes = (path) => JSON.parse(readFileSync(path, "utf8")).nodes;
const edits = (path) => JSON.parse(readFileSync(path, "utf8")).edits;

test("a grid is edited, saved and opened again: the same nodes, recipe and edits, to be gone on with", async () => {
  const studio = await drive.start("hexagon", "--no-autosave");
  const page = await drive.open(browser, studio.address, errors);
  await finished(page, await generate(page, { effort: "draft", edge_length: "0.7", seed: "5" }));
  await page.getByRole("button", { name: "Top", exact: true }).click();
  await page.click("#edit");
  await editing(page, "f", 2);
  const first = await save(page, "first.gridshell");
  assert.equal(edits(first).length, 2);

  // Another studio knows nothing of it.
  const another = await drive.start("dome", "--no-autosave");
  const there = await drive.open(browser, another.address, errors);
  await there.setInputFiles("#file", first);
  await there.waitForSelector(".headline", PATIENCE);
  assert.match(await there.title(), /^hexagon/);
  assert.equal(await there.locator("#field-seed").inputValue(), "5");
  assert.equal(await there.locator("#field-edge_length").inputValue(), "0.7");
  await there.getByRole("button", { name: "Top", exact: true }).click();
  await there.click("#edit");
  assert.equal(await there.locator(".steps.history li.before").count(), 2);
  assert.deepEqual(nodes(await save(there, "same.gridshell")), nodes(first));
  await editing(there, "s");
  const more = await save(there, "more.gridshell");
  assert.deepEqual(edits(more).slice(0, 2), edits(first));
  assert.equal(edits(more).length, 3);

  // Its recipe lays the same grid anew: as many nodes as before the split.
  await finished(there, await generate(there, {}));
  assert.equal((await seen(there)).runs.at(-1).nodes, nodes(first).length);
  await Promise.all([page.close(), there.close(), drive.kill(studio), drive.kill(another)]);
});

test("the studio is killed after edits: the next one offers them, and none is lost", async () => {
  const state = mkdtempSync(join(tmpdir(), "state-"));
  let studio = await drive.start("hexagon", "--state", state);
  let page = await drive.open(browser, studio.address, errors);
  // A surface of the user's own, which is gone by the time of the crash.
  const obj = join(folder, "fan.obj");
  writeFileSync(obj, "v 0 0 0\nv 6 0 0\nv 6 5 1\nv 0 5 0\nf 1 2 3 4\n");
  await page.setInputFiles("#file", obj);
  await page.waitForFunction(() => document.title.startsWith("fan"), null, PATIENCE);
  rmSync(obj);
  await finished(page, await generate(page, { effort: "draft", edge_length: "0.6" }));
  await page.getByRole("button", { name: "Top", exact: true }).click();
  await page.click("#edit");
  await editing(page, "f", 3);
  const before = await save(page, "before.gridshell");
  // What was saved is no longer kept, what is done since then is.
  await editing(page, "s", 4);
  const summary = (await seen(page)).runs.at(-1);
  await page.waitForTimeout(1500);
  await drive.kill(studio);
  await page.close();

  studio = await drive.start("hexagon", "--state", state);
  page = await drive.open(browser, studio.address, errors);
  await page.waitForSelector(".recovery:not([hidden])", PATIENCE);
  const told = await page.locator(".left-behind").innerText();
  assert.match(told, new RegExp(`fan, ${summary.nodes} nodes, 4 edits`));
  await page.getByRole("button", { name: "Recover" }).click();
  await page.waitForSelector(".headline", PATIENCE);
  await page.waitForSelector(".recovery", { state: "hidden" });
  assert.match(await page.title(), /^fan/);
  assert.equal((await seen(page)).runs.at(-1).nodes, summary.nodes);
  const after = await save(page, "after.gridshell");
  assert.deepEqual(edits(after).slice(0, 3), edits(before));
  assert.equal(edits(after).length, 4);
  await page.waitForTimeout(1500);
  await drive.kill(studio);
  await page.close();

  // It was saved by hand since: nothing is offered any more.
  studio = await drive.start("hexagon", "--state", state);
  page = await drive.open(browser, studio.address, errors);
  assert.ok(await page.locator(".recovery").isHidden());
  assert.equal(readdirSync(state).length, 1, "sessions without anything are cleared away");
  await page.close();
  await drive.kill(studio);
});

test("what is not wanted is discarded, and not offered again", async () => {
  const state = mkdtempSync(join(tmpdir(), "state-"));
  let studio = await drive.start("hexagon", "--state", state);
  let page = await drive.open(browser, studio.address, errors);
  await choose(page, "saddle");
  await finished(page, await generate(page, { effort: "draft", edge_length: "1.5" }));
  await page.waitForTimeout(1500);
  await drive.kill(studio);
  await page.close();
  for (const offered of [true, false]) {
    studio = await drive.start("hexagon", "--state", state);
    page = await drive.open(browser, studio.address, errors);
    assert.equal(await page.locator(".left-behind").count(), offered ? 1 : 0);
    if (offered) {
      await page.getByRole("button", { name: "Discard" }).click();
      await page.waitForSelector(".recovery", { state: "hidden" });
    }
    await page.close();
    await drive.kill(studio);
  }
});
