// How the browser gets in: nobody else sees the token, and it does not stay in the address.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { chmodSync, existsSync, mkdtempSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, dirname, join } from "node:path";
import { after, before, test } from "node:test";
import * as drive from "./drive.mjs";
import { PATIENCE, choose, finished, generate, seen } from "./drive.mjs";

let browser;
const errors = [];
before(async () => {
  browser = await drive.browse();
});
after(async () => {
  await browser?.close();
  assert.deepEqual(errors, [], "errors in the page");
});

/** The page is at its clean address, and goes on there when it is loaded again. */
async function clean(page) {
  await page.waitForURL((url) => url.pathname === "/", PATIENCE);
  for (let k = 0; k < 2; k++) {
    await page.reload();
    await page.waitForSelector("#generate:enabled", PATIENCE);
  }
  await choose(page, "dome");
  await choose(page, "hexagon");
}

test("the address is cleaned, the cookie serves for it, and only in this browser", async () => {
  const studio = await drive.start("hexagon", "--no-autosave");
  const context = await browser.newContext();
  const page = await context.newPage();
  await drive.visit(page, studio.address, errors);
  await clean(page);
  const cookies = await context.cookies();
  assert.equal(cookies.length, 1);
  assert.ok(cookies[0].httpOnly && cookies[0].sameSite === "Strict");
  assert.ok(!studio.address.includes(cookies[0].value));
  const root = new URL("/", studio.address).href;
  const another = await context.newPage();
  await drive.visit(another, root, errors);
  await finished(another, await generate(another, { effort: "draft", edge_length: "1" }));
  await page.waitForFunction(() => window.studio.seen.runs.length === 1, null, PATIENCE);
  // Another site's page in the same browser, which would have the cookie sent.
  const stranger = await context.newPage();
  await stranger.setContent(`<a href="${root}">in</a>`);
  const [answer] = await Promise.all([stranger.waitForResponse(root), stranger.click("a")]);
  assert.equal(answer.status(), 403);
  // Another browser.
  const other = await browser.newContext();
  const outside = await other.newPage();
  assert.equal((await outside.goto(root)).status(), 403);
  assert.match(await outside.innerText("body"), /from the terminal/);
  await Promise.all([context.close(), other.close()]);
  await drive.kill(studio);
});

test("the browser is opened with a file that only the user can read, and that goes", async () => {
  const folder = mkdtempSync(join(tmpdir(), "opener-"));
  const opener = join(folder, "xdg-open");
  const seenIn = join(folder, "arguments");
  writeFileSync(opener, `#!/bin/sh\nprintf '%s\\n' "$@" > ${seenIn}.new\nmv ${seenIn}.new ${seenIn}\n`);
  chmodSync(opener, 0o755);
  const page = process.env.STUDIO_PAGE ? ["--page", process.env.STUDIO_PAGE] : [];
  const server = spawn(process.env.GRIDSHELL, ["studio", "hexagon", "--no-autosave", ...page], {
    env: { ...process.env, PATH: `${folder}${delimiter}${process.env.PATH}` },
  });
  let said = "";
  server.stdout.on("data", (data) => (said += data));
  for (let k = 0; k < 300 && !existsSync(seenIn); k++) await new Promise((r) => setTimeout(r, 100));
  const told = readFileSync(seenIn, "utf8").trim();
  const token = said.match(/:\d+\/([0-9a-f]{32})\//)[1];
  assert.ok(!told.includes(token), "the token is in no arguments");
  assert.ok(!readFileSync(`/proc/${server.pid}/cmdline`, "utf8").includes(token));
  assert.equal(statSync(told).mode & 0o777, 0o600);
  assert.equal(statSync(dirname(told)).mode & 0o777, 0o700);
  assert.ok(readFileSync(told, "utf8").includes(token));
  const tab = await browser.newPage();
  await drive.visit(tab, `file://${told}`, errors);
  await clean(tab);
  for (let k = 0; k < 100 && existsSync(dirname(told)); k++) await new Promise((r) => setTimeout(r, 100));
  assert.ok(!existsSync(dirname(told)), "the file has gone, with its folder");
  assert.equal((await seen(tab)).runs.length, 0);
  await tab.close();
  await drive.kill({ server });
});
