// SPDX-License-Identifier: Apache-2.0
// A person before the live page: sees ball and robots move in a kick run and in a match, presses each kind of button, and what
// was pressed is on the bus, in the run's log.
//
// Usage: node view_test.mjs BIN   (the folder of the programs)
import assert from "node:assert/strict";
import fs from "node:fs";
import { after, afterEach, before, test } from "node:test";
import zlib from "node:zlib";
import { Run, changes, makeFolder, openBrowser, play, readLog, until } from "./browser.mjs";

const stop = "010";
const faultReport = "020";
const command = "050";

let browser;
const open = [];  // runs and pages of the test
before(async () => { browser = await openBrowser(); });
after(() => browser.close());
afterEach(async () => {
  for (const one of open.splice(0)) {
    await one.close();
  }
});

async function begin(...words) {
  const run = await Run.begin(...words);
  open.push(run);
  return [run, await look(run)];
}

async function look(run) {
  const page = await browser.open(run.url);
  open.push(page);
  await until(page, () => state !== undefined);
  return page;
}

const ticksOf = (frames, identifier) => frames.filter((frame) => frame.identifier === identifier).map((frame) => frame.tick);

// Longer ones than from a tick to the next.
const gaps = (ticks) => ticks.slice(1).map((tick, place) => tick - ticks[place]).filter((gap) => gap > 1);

async function pressSpeed(page, shown, speed) {
  await page.getByLabel("Speed").selectOption(shown);
  await until(page, (wanted) => state.speed === wanted, speed);
}

const press = (page, name) => page.getByRole("button", { name, exact: true }).click();

// Until the tick where it stands then.
async function pausesAndSteps(page) {
  await press(page, "Pause");
  await until(page, () => state.paused);
  const tick = await page.evaluate(() => state.tick);
  await press(page, "Step");
  await until(page, (from) => state.tick > from, tick);
  assert.equal(await page.evaluate(() => state.tick), tick + 1);
  await press(page, "Step a decision");
  await until(page, (wanted) => state.tick === wanted, tick + 51);
  return tick + 51;
}

test("a kick run", async () => {
  const [run, page] = await begin("kick", "--view", "--episodes", "200", "--seed", "5", "--log", "bus.log");
  await until(page, () => state.deciding);
  await changes(page, () => state.ball);
  await changes(page, () => state.robots[0].pose);
  await changes(page, () => byId("field").toDataURL());
  await until(page, () => document.querySelectorAll("#q tr").length === hello.actions.length);
  await until(page, () => byId("load").textContent.includes("%") && byId("bus").rows.length > 8);
  const stood = await pausesAndSteps(page);
  await press(page, "Run");
  await until(page, (tick) => state.tick > tick, stood);
  await pressSpeed(page, "5", 5);
  await pressSpeed(page, "0.1", 0.1);
  await until(page, () => state.deciding && state.contact === null && state.robots[0].state === "active");
  await press(page, "Pause");  // a browser may be slow
  await press(page, "interface_down");
  await until(page, () => state.note[1].startsWith("interface_down"));
  await press(page, "Run");
  const faulty = await until(page, () => (state.robots[0].fault ?? "none") !== "none" && state.tick);
  await pressSpeed(page, "1", 1);
  await until(page, () => state.robots[0].fault === "none");  // cleared by the next episode's operator
  const pressed = await page.evaluate(() => state.tick);
  await press(page, "Emergency stop");
  assert.match(await until(page, () => byId("ended").textContent), /emergency stop/);
  assert.ok(await page.getByRole("button", { name: "Pause" }).isDisabled());
  const { status, said } = await run.ended();
  assert.equal(status, 4, said);
  assert.deepEqual(page.problems, []);

  const frames = readLog(fs.readFileSync(run.file("bus.log"), "ascii"));
  const stops = ticksOf(frames, stop);
  assert.equal(stops.length, 1);
  assert.ok(stops[0] >= pressed);
  const reports = ticksOf(frames, faultReport);
  assert.ok(reports.some((tick) => faulty - 1200 < tick && tick <= faulty), `${faulty}: ${reports.slice(0, 5)}`);
  // No frame came out of the controller while its interface was down.
  assert.deepEqual(gaps(ticksOf(frames, command)), [501]);
});

test("a match", async () => {
  const [run, page] = await begin("match", "--view", "--half-s", "900", "--seed", "2", "-o", "out");
  assert.equal(await page.evaluate(() => state.robots.length), 10);
  await until(page, () => byId("game").textContent.includes("half 1"));
  await until(page, () => state.match.state !== "pause");
  await changes(page, () => state.ball);
  await changes(page, () => state.robots[0].pose);
  await changes(page, () => state.robots[4].pose);
  await changes(page, () => state.robots[9].pose);
  await changes(page, () => byId("field").toDataURL());
  const stood = await pausesAndSteps(page);
  await page.getByLabel("Speed").selectOption("max");
  await press(page, "Run");
  await until(page, (tick) => state.speed === 0 && state.tick > tick, stood);
  await pressSpeed(page, "1", 1);
  await page.getByRole("combobox", { name: "Robot" }).selectOption("4");
  await press(page, "bus_off");
  await until(page, () => state.note[1].startsWith("bus_off on robot 4"));
  await page.getByRole("combobox", { name: "Robot" }).selectOption("2");
  await press(page, "Stop this robot");
  await until(page, () => state.robots[2].fault === "emergency_stop");
  assert.equal(await page.evaluate(() => state.robots.filter((one) => one.fault === "emergency_stop").length), 1);
  await press(page, "Emergency stop");
  await until(page, () => state.robots.every((one) => one.faults.includes("emergency_stop")));
  run.process.kill("SIGTERM");
  const { status, said } = await run.ended();
  assert.equal(status, 130, said);
  await until(page, () => byId("ended").textContent.includes("interrupted"));
  assert.deepEqual(page.problems, []);

  for (let robot = 0; robot < 10; ++robot) {
    const frames = readLog(zlib.gunzipSync(fs.readFileSync(run.file(`out/bus/vcan${robot}.log.gz`))).toString("ascii"));
    const stops = ticksOf(frames, stop).length;
    if (robot === 4) {  // which may be off its bus when it is pressed, and then hears a later one
      assert.ok(stops >= 1);
    } else {
      assert.equal(stops, robot === 2 ? 2 : 1, `robot ${robot}`);
    }
    assert.deepEqual(gaps(ticksOf(frames, command)), robot === 4 ? [501] : [], `robot ${robot}`);
    assert.ok(ticksOf(frames, faultReport).length > 0, `robot ${robot}`);
  }
});

test("a restart plays the run of that seed", async () => {
  const words = ["kick", "--view", "--episodes", "2", "--log", "bus.log"];
  const [run, page] = await begin(...words, "--view-speed", "0.5", "--seed", "5");
  const seed = "18446744073709551615";
  await page.getByLabel("Seed").fill(seed);
  await press(page, "Restart");
  await until(page, (wanted) => state.run === 2 && state.seed === wanted, seed);
  await pressSpeed(page, "max", 0);
  assert.equal((await run.ended()).status, 0);
  await until(page, () => byId("ended").textContent.includes("all episodes were played"));
  assert.deepEqual(page.problems, []);
  const plain = makeFolder();
  await play("striker-sil", ["kick", "--episodes", "2", "--log", "bus.log", "--seed", seed], plain);
  assert.ok(fs.readFileSync(run.file("bus.log")).equals(fs.readFileSync(`${plain}/bus.log`)));
  fs.rmSync(plain, { recursive: true });
  assert.deepEqual(fs.readdirSync(run.folder), ["bus.log"]);
});

test("a held key and numbers that are none lose no connection", async () => {
  const [run, page] = await begin("kick", "--view", "--view-speed", "0.1", "--episodes", "200");
  for (const wrong of ["", "-1", "1.5", "1e3", "18446744073709551616"]) {
    await page.getByLabel("Seed").fill(wrong);
    await press(page, "Restart");
  }
  for (const wrong of ["", "0", "1.5", "60001"]) {
    await page.getByLabel("Faults, for").fill(wrong);
    await press(page, "loss");
  }
  await page.evaluate(() => {
    for (let pressed = 0; pressed < 200; ++pressed) {
      byId("step").click();
      byId("stop").click();
    }
  });
  await until(page, () => state.note[1] === "emergency stop");
  const { status } = await run.ended();
  assert.equal(status, 4);
  assert.equal(await page.evaluate(() => state.run), 1);
  assert.match(await until(page, () => byId("ended").textContent), /emergency stop/);
});
