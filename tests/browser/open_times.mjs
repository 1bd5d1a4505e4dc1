// SPDX-License-Identifier: Apache-2.0
// How big pages are, and how long each takes from being asked for to its first drawn picture, in a browser that is there
// already. It prints, and judges nothing: what it measures is this machine and its load as well.
//
// Usage: node open_times.mjs REPORT.html...
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { openBrowser } from "./browser.mjs";

const openings = 5;
const browser = await openBrowser();

async function openingMs(file) {
  const begun = performance.now();
  const page = await browser.open(`file://${path.resolve(file)}`);
  // The first callback comes before a picture is drawn, the second after it.
  await page.evaluate(() => new Promise((drawn) => { requestAnimationFrame(() => requestAnimationFrame(drawn)); }));
  const passed = performance.now() - begun;
  await page.close();
  return passed;
}

for (const file of process.argv.slice(2)) {
  const times = [];
  for (let opening = 0; opening < openings; ++opening) {
    times.push(Math.round(await openingMs(file)));
  }
  times.sort((one, other) => one - other);
  console.log(`${file}: ${(fs.statSync(file).size / 1e6).toFixed(2)} MB, first picture after ${times.join(", ")} ms; ` +
              `${os.cpus().length} processors, load ${os.loadavg()[0].toFixed(1)}`);
}
await browser.close();
