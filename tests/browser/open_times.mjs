// SPDX-License-Identifier: Apache-2.0
// How big pages are, and how long each takes from being asked for to its first drawn picture, in a browser that is there
// already, with the processor time of all its processes, which the machine's load changes less. It prints, and judges nothing.
//
// Usage: node open_times.mjs REPORT.html...
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { openBrowser } from "./browser.mjs";

const openings = 5;
const browser = await openBrowser();

async function opening(file) {
  const page = await browser.open("about:blank");
  const used_ms = await browser.processorMs();
  const begun = performance.now();
  await page.goto(`file://${path.resolve(file)}`);
  // The first callback comes before a picture is drawn, the second after it.
  await page.evaluate(() => new Promise((drawn) => { requestAnimationFrame(() => requestAnimationFrame(drawn)); }));
  const passed_ms = performance.now() - begun;
  const processor_ms = await browser.processorMs() - used_ms;
  await page.close();
  return { passed_ms, processor_ms };
}

const shown = (values) => values.map(Math.round).sort((one, other) => one - other).join(", ");

for (const file of process.argv.slice(2)) {
  const all = [];
  for (let number = 0; number < openings; ++number) {
    all.push(await opening(file));
  }
  console.log(`${file}: ${(fs.statSync(file).size / 1e6).toFixed(2)} MB; first picture after ` +
              `${shown(all.map((one) => one.passed_ms))} ms; ${shown(all.map((one) => one.processor_ms))} ms of processor time; ` +
              `${os.cpus().length} processors, load ${os.loadavg()[0].toFixed(1)}`);
}
await browser.close();
