// The pictures of docs/studio.md: `npm run tour`, with a release build of the command in GRIDSHELL.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import * as drive from "./drive.mjs";
import { PATIENCE, choose, finished, generate } from "./drive.mjs";

const root = join(import.meta.dirname, "../../../..");
const files = join(root, "crates/gridshell/tests/files");
const state = mkdtempSync(join(tmpdir(), "tour-"));
const errors = [];

const browser = await drive.browse();
let studio = await drive.start("great-court", "--state", state);
let page = await drive.open(browser, studio.address, errors);

async function picture(name) {
  await page.waitForTimeout(1200);
  await page.screenshot({ path: join(root, "docs/studio", `${name}.png`) });
  console.log(name);
}
const button = (name) => page.getByRole("button", { name, exact: true });
async function point(x, y) {
  const box = await page.locator(".host canvas").first().boundingBox();
  await page.mouse.move(box.x + x * box.width, box.y + y * box.height);
  await page.waitForTimeout(400);
  return [box.x + x * box.width, box.y + y * box.height];
}

await picture("start");

await page.setInputFiles("#file", join(files, "objects_v7.3dm"));
await page.waitForFunction(() => document.title.startsWith("objects"), null, PATIENCE);
await page.locator("#parts tbody tr").nth(2).hover();
await picture("parts");

await page.waitForSelector(".toast", { state: "hidden", ...PATIENCE });
await choose(page, "great-court");
const paper = await generate(page, { effort: "draft", method: "paper" });
await page.waitForFunction(() => window.studio.seen.liveFrames > 20, null, PATIENCE);
await picture("bubbles");
await finished(page, paper);

await finished(page, await generate(page, { effort: "standard", method: "default" }));
await picture("grid");
await page.click(".candidates summary");
await page.waitForSelector(".thumb canvas:not([hidden])", PATIENCE);
await page.locator("#take").scrollIntoViewIfNeeded();
await picture("candidates");
await page.locator(".report").first().scrollIntoViewIfNeeded();

await page.click("#compare");
await page.selectOption("#color", "disfluency");
await page.waitForSelector(".legend:not([hidden])", PATIENCE);
await picture("compare");
await page.click("#compare");
await page.selectOption("#color", "");

await page.locator(".run").nth(1).click();
await button("Top").click();
await page.click("#edit");
await page.waitForSelector(".step.good", PATIENCE);
await page.waitForTimeout(1500);
// A member with something to gain: the first suggested.
await page.locator(".step.good").first().hover();
await picture("edit");

await point(0.36, 0.83);
await page.keyboard.press("l");
await page.mouse.click(...(await point(0.5, 0.85)));
await page.mouse.click(...(await point(0.64, 0.83)));
await picture("guide");
await page.keyboard.press("Enter");
await page.waitForSelector(".steps.history li.done", PATIENCE);
await page.waitForTimeout(1500);

await drive.kill(studio);
await page.close();
studio = await drive.start("dome", "--state", state);
page = await drive.open(browser, studio.address, errors);
await page.waitForSelector(".recovery:not([hidden])", PATIENCE);
await picture("recover");

await drive.kill(studio);
await browser.close();
rmSync(state, { recursive: true });
rmSync(drive.folder, { recursive: true });
if (errors.length) throw new Error(errors.join("\n"));
