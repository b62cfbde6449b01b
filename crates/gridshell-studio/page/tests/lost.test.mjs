// Nothing is lost unsaid: grids make way, copies fail, files are damaged, saving goes wrong.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, readdirSync, renameSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import * as drive from "./drive.mjs";
import { PATIENCE, downloaded, editing, finished, generate, seen } from "./drive.mjs";

let browser;
const errors = [];
before(async () => {
  browser = await drive.browse();
});
after(async () => {
  await browser?.close();
  assert.deepEqual(errors, [], "errors in the page");
});

/** Keep a picture where SHOTS names a folder for them. */
async function shot(page, name) {
  if (process.env.SHOTS) await page.screenshot({ path: join(process.env.SHOTS, `${name}.png`) });
}

const draft = (seed) => ({ effort: "draft", edge_length: "1", seed: String(seed) });
const notice = (page, key) => page.locator(`[data-notice="${key}"]`);
/** The autosaves in `state`, as `session/file`. */
const copies = (state) =>
  readdirSync(state).flatMap((session) =>
    readdirSync(join(state, session))
      .filter((file) => file.endsWith(".gridshell"))
      .map((file) => join(session, file)),
  );
/** Wait until `test` holds. */
async function until(what, test) {
  for (let k = 0; k < 200; k++) {
    if (await test()) return;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  assert.fail(what);
}

test("an edited grid stays, however many are laid after it; what makes way is told", async () => {
  const state = mkdtempSync(join(tmpdir(), "state-"));
  const studio = await drive.start("hexagon", "--state", state);
  const page = await drive.open(browser, studio.address, errors);
  await finished(page, await generate(page, draft(1)));
  await page.getByRole("button", { name: "Top", exact: true }).click();
  await page.click("#edit");
  await editing(page, "f");
  const edited = (await seen(page)).shown;
  assert.equal(await page.locator(".run .unsaved").count(), 1);
  for (let seed = 2; seed < 16; seed++) await finished(page, await generate(page, draft(seed)));
  const runs = (await seen(page)).runs;
  assert.equal(runs.length, 13, "twelve without changes, and the edited one");
  assert.ok(runs.find((r) => r.run === edited)?.unsaved);
  const told = await notice(page, "put away").innerText();
  assert.match(told, /Put away to make room.*hexagon, 1\.000 m, draft, seed 3 .*seed 2/s);
  await until("the edited grid is kept against crashes", () =>
    copies(state).some((c) => c.endsWith(`/${edited}.gridshell`)),
  );
  await shot(page, "put-away");
  await notice(page, "put away").getByRole("button", { name: "Dismiss" }).click();
  assert.equal(await page.locator(".notice").count(), 0);
  await drive.kill(studio);
  await page.close();
});

test("a failing autosave is told, in new tabs too, and again when it works", async () => {
  const state = mkdtempSync(join(tmpdir(), "state-"));
  const studio = await drive.start("hexagon", "--state", state);
  const page = await drive.open(browser, studio.address, errors);
  const session = join(state, readdirSync(state)[0]);
  renameSync(session, `${session}.away`);
  await finished(page, await generate(page, draft(1)));
  await notice(page, "autosave").waitFor(PATIENCE);
  assert.match(
    await notice(page, "autosave").innerText(),
    /cannot be kept against crashes: run \d+: .*Save what you need/,
  );
  await shot(page, "autosave");
  const another = await drive.open(browser, studio.address, errors);
  await notice(another, "autosave").waitFor(PATIENCE);
  renameSync(`${session}.away`, session);
  for (const tab of [page, another]) {
    await notice(tab, "autosave").waitFor({ state: "detached", ...PATIENCE });
    await tab.waitForSelector(".toast:not([hidden])", PATIENCE);
    assert.match(await tab.locator(".toast").innerText(), /kept against crashes again/);
  }
  assert.equal(copies(state).length, 1);
  await drive.kill(studio);
  await Promise.all([page.close(), another.close()]);
});

test("damaged autosaves are told and stay; the whole ones are recovered", async () => {
  const state = mkdtempSync(join(tmpdir(), "state-"));
  let studio = await drive.start("hexagon", "--state", state);
  let page = await drive.open(browser, studio.address, errors);
  for (const seed of [1, 2, 3]) await finished(page, await generate(page, draft(seed)));
  await until("three copies", () => copies(state).length === 3);
  await page.waitForTimeout(500);
  await drive.kill(studio);
  await page.close();
  const torn = copies(state).find((c) => c.endsWith("/2.gridshell") || c.endsWith("/3.gridshell"));
  const whole = readFileSync(join(state, torn));
  writeFileSync(join(state, torn), whole.subarray(0, whole.length - 200));

  studio = await drive.start("hexagon", "--state", state);
  page = await drive.open(browser, studio.address, errors);
  await page.waitForSelector(".damaged", PATIENCE);
  const told = await page.locator(".left-behind").innerText();
  assert.match(told, /This one is damaged and cannot be recovered/);
  assert.ok(told.includes(state) && told.includes(torn.split("/")[1]), told);
  await shot(page, "damaged");
  await page.getByRole("button", { name: "Recover" }).click();
  await page.waitForFunction(() => window.studio.seen.runs.length === 2, null, PATIENCE);
  await page.waitForFunction(() => document.querySelectorAll(".left-behind li").length === 1, null, PATIENCE);
  assert.deepEqual(readFileSync(join(state, torn)), whole.subarray(0, whole.length - 200));
  await shot(page, "damaged-only");
  await page.getByRole("button", { name: "Later" }).click();
  assert.ok(await page.locator(".recovery").isHidden());
  await drive.kill(studio);
  await page.close();

  // Nothing but the damaged one is left of that session: it is told all the same, until it is discarded.
  for (const there of [true, false]) {
    studio = await drive.start("hexagon", "--state", state);
    page = await drive.open(browser, studio.address, errors);
    await page.waitForTimeout(500);
    const session = page.locator(`[data-session="${torn.split("/")[0]}"]`);
    assert.equal(await session.count(), there ? 1 : 0);
    if (there) {
      assert.equal(await session.getByRole("button", { name: "Recover" }).count(), 0);
      await session.getByRole("button", { name: "Discard all" }).click();
      await session.waitFor({ state: "detached", ...PATIENCE });
      assert.ok(!copies(state).includes(torn));
    }
    await drive.kill(studio);
    await page.close();
  }
});

test("only what the user has counts as saved: by a download when they say so, by a file when it is written", async () => {
  const state = mkdtempSync(join(tmpdir(), "state-"));
  const studio = await drive.start("hexagon", "--state", state);
  const page = await drive.open(browser, studio.address, errors);
  await finished(page, await generate(page, draft(1)));
  await until("a copy", () => copies(state).length === 1);
  await downloaded(page, "a.gridshell", () => page.keyboard.press("Control+s"));
  await downloaded(page, "a.obj", () => page.selectOption("#export", "obj"));
  await page.waitForTimeout(1500);
  assert.equal(copies(state).length, 1, "nobody said that it arrived");
  await shot(page, "saved");
  await page.getByRole("button", { name: "It is there" }).click();
  await until("no copy", () => copies(state).length === 0);
  await page.close();

  // A browser that lets pages write files: it is cancelled, fails, and works.
  const writing = await browser.newPage();
  await writing.addInitScript(() => {
    window.outcome = "cancel";
    window.picks = 0;
    window.showSaveFilePicker = async ({ suggestedName }) => {
      window.picks++;
      if (window.outcome === "cancel") throw new DOMException("The user aborted a request.", "AbortError");
      return {
        name: suggestedName,
        createWritable: async () => ({
          write: async (blob) => (window.written = await blob.text()),
          close: async () => {
            if (window.outcome === "fail") throw new Error("the disk is full");
          },
        }),
      };
    };
  });
  await drive.visit(writing, studio.address, errors);
  await finished(writing, await generate(writing, draft(2)));
  await until("a copy", () => copies(state).length === 1);
  for (const [outcome, told] of [
    ["cancel", null],
    ["fail", /is not saved: the disk is full/],
    ["work", /hexagon-\d+\.gridshell is saved/],
    ["again", /hexagon-\d+\.gridshell is saved/],
  ]) {
    await writing.evaluate((o) => (window.outcome = o), outcome);
    await writing.keyboard.press("Control+s");
    if (told) await writing.locator(".toast:not([hidden])", { hasText: told }).waitFor(PATIENCE);
    await writing.waitForTimeout(1000);
    assert.equal(copies(state).length, told?.source.endsWith("is saved") ? 0 : 1, outcome);
  }
  assert.equal(await writing.evaluate(() => window.picks), 3, "once it is chosen, nobody is asked again");
  assert.equal(
    JSON.parse(await writing.evaluate(() => window.written)).schema.split("/")[0],
    "gridshell.grid",
  );
  await drive.kill(studio);
  await writing.close();
});
