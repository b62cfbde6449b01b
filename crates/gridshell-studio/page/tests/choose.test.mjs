// What a person chooses: parts and layers of a file, a candidate, a guide, what is taken away.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import * as drive from "./drive.mjs";
import { PATIENCE, choose, downloaded, finished, generate, seen } from "./drive.mjs";

const files = join(import.meta.dirname, "../../../gridshell/tests/files");
const open = drive.staged("hexagon", "--no-autosave");

const opened = (page, name) => page.waitForFunction((n) => document.title.startsWith(n), name, PATIENCE);

test("of a file of several parts one is chosen, and the grid is laid on it", async () => {
  const page = await open();
  await page.setInputFiles("#file", join(files, "assembly_m.step"));
  await opened(page, "assembly_m");
  const rows = page.locator("#parts tbody tr");
  const areas = await rows.locator("td:last-child").allInnerTexts();
  assert.ok(areas.length > 2 && areas.every((a) => /m²$/.test(a)), areas.join(", "));
  await rows.nth(2).locator("input").check();
  assert.equal(await page.locator("#field-part").inputValue(), "2");
  await finished(page, await generate(page, { effort: "draft", edge_length: "", nodes: "150" }));
  const area = await page.locator(".report").innerText();
  assert.match(area, /part 2 of/);
  await page.close();
});

test("layers of a 3DM file are left out and read again", async () => {
  const page = await open();
  await page.setInputFiles("#file", join(files, "objects_v7.3dm"));
  await opened(page, "objects_v7");
  const parts = () => page.locator("#parts tbody tr").count();
  const before = await parts();
  await page.locator("#objects .layer", { hasText: "solids" }).locator("input").uncheck();
  await page.click("#read-chosen");
  await page.waitForFunction(
    (n) => document.querySelectorAll("#parts tbody tr").length < n,
    before,
    PATIENCE,
  );
  assert.match(await page.locator("#objects tr", { hasText: "ball" }).innerText(), /left out/);
  await page.getByRole("button", { name: "All shown" }).click();
  await page.waitForFunction(
    (n) => document.querySelectorAll("#parts tbody tr").length === n,
    before,
    PATIENCE,
  );
  await page.close();
});

test("a candidate is looked at and taken instead of the best", async () => {
  const page = await open();
  await choose(page, "saddle");
  await finished(page, await generate(page, { effort: "draft", nodes: "150" }));
  await page.click(".candidates summary");
  await page.waitForSelector(".thumb canvas:not([hidden])", PATIENCE);
  const drawn = (await seen(page)).drawn;
  await page.locator(".thumb").nth(1).click();
  await page.waitForFunction((n) => window.studio.seen.drawn > n, drawn, PATIENCE);
  const best = (await seen(page)).runs.at(-1).run;
  await page.click("#take");
  await page.waitForFunction((n) => window.studio.seen.shown > n, best, PATIENCE);
  const taken = (await seen(page)).runs.at(-1);
  assert.match(taken.detail, new RegExp(`candidate 2 of run ${best}`));
  const grid = await downloaded(page, "taken.gridshell", () => page.click("#save"));
  assert.equal(JSON.parse(readFileSync(grid, "utf8")).nodes.length, taken.nodes);
  await page.close();
});

test("a guide is drawn on the grid, followed, and removed; so is an anchor", async () => {
  const page = await open();
  await choose(page, "hexagon");
  await finished(page, await generate(page, { effort: "draft", edge_length: "0.5", nodes: "" }));
  await page.getByRole("button", { name: "Top", exact: true }).click();
  await page.click("#edit");
  const box = await page.locator(".host canvas").first().boundingBox();
  const point = async (x, y) => {
    await page.mouse.move(box.x + x * box.width, box.y + y * box.height);
    await page.waitForTimeout(300);
  };
  const done = (n, text) =>
    page.waitForFunction(
      ([n, text]) => {
        const rows = [...document.querySelectorAll(".steps.history li.done")];
        return rows.length === n && rows[0].textContent.includes(text);
      },
      [n, text],
      PATIENCE,
    );
  await point(0.4, 0.42);
  await page.keyboard.press("l");
  await point(0.6, 0.5);
  await page.mouse.click(box.x + 0.6 * box.width, box.y + 0.5 * box.height);
  await page.keyboard.press("Enter");
  await done(1, "add a guide");
  const features = async (name) => {
    const path = await drive.saved(page, name);
    return JSON.parse(readFileSync(path, "utf8")).features.length;
  };
  assert.ok((await features("guided.gridshell")) >= 3);
  await point(0.5, 0.46);
  await page.keyboard.press("r");
  await done(2, "remove the guide");
  assert.equal(await features("unguided.gridshell"), 0);

  await point(0.45, 0.6);
  await page.keyboard.press("a");
  await done(3, "add an anchor");
  await page.mouse.move(box.x + 2, box.y + 2);
  await point(0.45, 0.6);
  await page.keyboard.press("r");
  await done(4, "remove the anchor");
  await page.close();
});

test("a report, the schedules and the run document are taken away, edits and all", async () => {
  const page = await open();
  await choose(page, "hexagon");
  await finished(page, await generate(page, { effort: "draft", edge_length: "0.8" }));
  await page.getByRole("button", { name: "Top", exact: true }).click();
  await page.click("#edit");
  await drive.editing(page, "s");
  const { nodes } = (await seen(page)).runs.at(-1);
  const take = (format) => downloaded(page, `taken.${format}`, () => page.selectOption("#export", format));
  const report = readFileSync(await take("report.html"), "utf8");
  assert.ok(report.includes("<html") && report.includes(`<b>${nodes}</b><span>nodes</span>`));
  const archive = readFileSync(await take("csv.zip"));
  assert.equal(archive.subarray(0, 2).toString(), "PK");
  for (const table of ["nodes", "members", "panels"]) assert.ok(archive.includes(`.${table}.csv`), table);
  const run = JSON.parse(readFileSync(await take("run.json"), "utf8"));
  assert.equal(run.quality.nodes, nodes);
  assert.equal(run.edits.length, 1);
  await page.close();
});
