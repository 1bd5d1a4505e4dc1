// SPDX-License-Identifier: Apache-2.0
// Debian's Chromium, driven by playwright-core, and runs of striker-sil that it looks at.
//
//   const browser = await openBrowser();
//   const run = await Run.begin("kick", "--view");
//   const page = await browser.open(run.url);
//   await until(page, () => state.tick > 100);       // in the page, until it holds
//   const { status } = await run.ended();
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { setTimeout as sleep } from "node:timers/promises";
import { chromium } from "playwright-core";

export const bin = path.resolve(process.argv[2] ?? "build/bin");

const patience_ms = 300_000;  // a machine may be busy

export function makeFolder() {
  return fs.mkdtempSync(path.join(os.tmpdir(), "striker-browser-"));
}

// What a page throws or writes to its console as an error fails the test that closes it.
export async function openBrowser() {
  const chrome = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--disable-dev-shm-usage", "--disable-gpu"] });
  return {
    async open(url) {
      const page = await chrome.newPage();
      page.setDefaultTimeout(patience_ms);
      page.problems = [];
      page.on("pageerror", (error) => page.problems.push(error.message));
      page.on("console", (message) => message.type() === "error" && page.problems.push(message.text()));
      await page.goto(url);
      return page;
    },
    // That all its processes had so far.
    async processorMs() {
      const session = await chrome.newBrowserCDPSession();
      const { processInfo } = await session.send("SystemInfo.getProcessInfo");
      return processInfo.reduce((sum, one) => sum + 1000 * one.cpuTime, 0);
    },
    close: () => chrome.close(),
  };
}

// What `read` gives, as soon as it is true.
async function poll(page, read, what) {
  for (const end = Date.now() + patience_ms; Date.now() < end; await sleep(30)) {
    const value = await read();
    if (value) {
      return value;
    }
  }
  const shown = await page.evaluate(() => document.body.innerText.slice(0, 1500));
  throw new Error(`never true: ${what}; ${page.problems}; the page says: ${shown}`);
}

// The function's value in the page, as soon as it is true.
export function until(page, holds, argument) {
  return poll(page, () => page.evaluate(holds, argument), `${holds} of ${JSON.stringify(argument)}`);
}

// Until the function's value in the page is another than it was.
export async function changes(page, what) {
  const read = async () => JSON.stringify(await page.evaluate(what));
  const before = await read();
  return poll(page, async () => await read() !== before, `a change of ${what}`);
}

// A program of this build that was run to its end.
export async function play(program, words, cwd) {
  const child = spawn(path.join(bin, program), words, { cwd, stdio: ["ignore", "ignore", "pipe"] });
  let said = "";
  child.stderr.on("data", (text) => { said += text; });
  const status = await new Promise((resolve) => { child.on("close", resolve); });
  assert.equal(status, 0, said);
}

// striker-sil with a live view, in a folder of its own.
export class Run {
  static async begin(...words) {
    const run = new Run();
    run.folder = makeFolder();
    run.said = "";
    run.process = spawn(path.join(bin, "striker-sil"), words, { cwd: run.folder, stdio: ["ignore", "ignore", "pipe"] });
    run.process.stderr.on("data", (text) => { run.said += text; });
    run.closed = new Promise((resolve) => { run.process.on("close", (status) => { run.status = status; resolve(); }); });
    while (!run.url) {
      await Promise.race([sleep(20), run.closed]);
      run.url = run.said.match(/live view: (http:\S+)/)?.[1];
      assert.ok(run.url || run.status === undefined, run.said);
    }
    return run;
  }

  file(name) {
    return path.join(this.folder, name);
  }

  async ended() {
    await this.closed;
    return { status: this.status, said: this.said };
  }

  async close() {
    this.process.kill("SIGKILL");
    await this.closed;
    fs.rmSync(this.folder, { recursive: true });
  }
}

// Frames of a candump log: its line, the stamp as a tick in ms, the identifier, the data.
export function readLog(text) {
  return text.trimEnd().split("\n").map((line, place) => {
    const [, stamp, identifier, data] = line.match(/^\((\S+)\) \S+ (\w+)#(\w*)/);
    return { line: place + 1, tick: Math.round(1000 * Number(stamp)), identifier, data: Buffer.from(data, "hex") };
  });
}
