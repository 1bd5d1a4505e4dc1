// SPDX-License-Identifier: Apache-2.0
// A person before a report: opens it, moves the slider of a kick run and of a match, and what it shows then is what the logs
// carried. The logs are read here with nothing of the report's.
//
// Usage: node report_test.mjs BIN   (the folder of the programs)
import assert from "node:assert/strict";
import fs from "node:fs";
import { after, afterEach, before, beforeEach, test } from "node:test";
import zlib from "node:zlib";
import { changes, makeFolder, openBrowser, play, readLog, until } from "./browser.mjs";

const folder = makeFolder();
let browser;
let page;

before(async () => {
  fs.mkdirSync(`${folder}/kicks`);
  await play("striker-sil", ["kick", "--episodes", "4", "--seed", "5", "--log", "bus.log", "--json", "kick.json"], `${folder}/kicks`);
  await play("striker-sil", ["match", "--half-s", "3", "--seed", "2", "-o", "match"], folder);
  await play("striker-report", ["kicks", "match", "-o", "report.html"], folder);
  browser = await openBrowser();
});
after(async () => {
  await browser.close();
  fs.rmSync(folder, { recursive: true });
});
beforeEach(async () => { page = await browser.open(`file://${folder}/report.html`); });
afterEach(async () => {
  assert.deepEqual(page.problems, []);
  await page.close();
});

// Each picture of the robot in a log: its line, tick, and place in mm.
function posesOf(text) {
  return readLog(text).filter((frame) => frame.identifier === "070")
    .map(({ line, tick, data }) => ({ line, tick, x: data.readInt16LE(2) / 4, y: data.readInt16LE(4) / 4 }));
}

function showsPlace(text, robot, { x, y }) {
  const shown = text.match(new RegExp(`robot ${robot} \\((-?\\d+), (-?\\d+)\\) mm`)).slice(1).map(Number);
  assert.ok(Math.hypot(shown[0] - x, shown[1] - y) < 1, `${text}, but robot ${robot} was at (${x}, ${y}) mm`);
}

const slider = (number) => page.getByRole("slider", { name: "time" }).nth(number);
const stateText = (number) => page.locator(`#state${number}`).textContent();

test("the slider goes through an episode's pictures as the log has them", async () => {
  const poses = posesOf(fs.readFileSync(`${folder}/kicks/bus.log`, "ascii"));
  await page.locator("tr[data-replay='2']").first().click();
  const here = async () => {
    const [, seconds, line] = (await stateText(0)).match(/^episode 2, .*: ([\d.]+) s\nbus\.log line (\d+)\n/);
    const place = poses.findIndex((pose) => pose.line === Number(line));
    assert.notEqual(place, -1, `line ${line} is no picture`);
    showsPlace(await stateText(0), 0, poses[place]);
    return { place, ms: Math.round(1000 * seconds) };
  };
  await slider(0).focus();
  await page.keyboard.press("ArrowRight");  // from the picture before the first decision
  const first = await here();
  for (let pressed = 0; pressed < 14; ++pressed) {
    await page.keyboard.press("ArrowRight");
  }
  const moved = await here();
  assert.equal(moved.place, first.place + 14);
  assert.equal(moved.ms - first.ms, poses[moved.place].tick - poses[first.place].tick);
  await page.keyboard.press("End");
  const last = await here();
  assert.ok(last.place > moved.place);
  await page.reload();  // the address keeps the moment
  assert.deepEqual(await here(), last);
});

test("the slider shows of a match what ten buses said, and moves the picture", async () => {
  const field = () => document.querySelectorAll("canvas.field")[1].toDataURL();
  const before = await page.evaluate(field);
  await slider(1).click();  // in its middle
  assert.ok(await page.evaluate(field) !== before, "the field has not changed");
  const text = await stateText(1);
  const tick = Math.round(1000 * Number(text.match(/: ([\d.]+) s\n/)[1]));
  assert.ok(tick > 5000 && tick < 9000, text);
  for (let robot = 0; robot < 10; ++robot) {
    const log = zlib.gunzipSync(fs.readFileSync(`${folder}/match/bus/vcan${robot}.log.gz`)).toString("ascii");
    showsPlace(text, robot, posesOf(log).find((pose) => pose.tick === tick));
  }
});

test("play lets time pass, and pause ends it", async () => {
  await page.getByRole("button", { name: "play" }).first().click();
  await changes(page, () => document.getElementById("state0").textContent);
  await page.getByRole("button", { name: "pause" }).first().click();
  const stood = await stateText(0);
  await page.waitForTimeout(200);
  assert.equal(await stateText(0), stood);
});
