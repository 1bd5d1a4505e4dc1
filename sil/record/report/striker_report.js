// SPDX-License-Identifier: Apache-2.0
// Draws `runs` (striker_runs.py), with striker_field.js before it. "#run=0&replay=3&time=1200" in the address opens a
// moment of the replay with that number; moving a slider writes it.
"use strict";

const runs = JSON.parse(document.getElementById("data").textContent);

// The place of the last entry that is not later.
function placeOf(times, time) {
  let low = 0;
  let high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low;
}

class Replay {
  constructor(run, number, parent) {
    this.run = run;
    this.number = number;
    this.replay = run.replays[0];
    this.canvas = element("canvas", undefined, parent);
    this.canvas.width = 1200;
    this.canvas.height = 660;
    this.canvas.className = "field";
    this.slider = element("input", undefined, parent);
    this.slider.type = "range";
    this.slider.setAttribute("aria-label", "time");
    this.button = element("button", "play", parent);
    this.state = element("div", undefined, parent);
    this.state.className = "state";
    this.state.id = `state${number}`;
    this.plots = element("div", undefined, parent);
    this.charts = [];
    this.marks = element("ul", undefined, element("div", undefined, parent));
    this.marks.parentElement.className = "scroll";
    this.slider.addEventListener("input", () => this.show(Number(this.slider.value), true));
    this.button.addEventListener("click", () => this.togglePlay());
    this.choose(this.replay.number);
  }

  has(which) {
    return this.run.replays.some((replay) => replay.number === which);
  }

  choose(which) {
    this.which = which;
    this.replay = this.run.replays.find((replay) => replay.number === which);
    this.slider.min = 0;
    this.slider.max = Math.max(0, this.replay.times.length - 1);
    this.marks.replaceChildren();
    for (const [time, text] of this.replay.marks) {
      const mark = element("li", `${(time / 1000).toFixed(2)} s: ${text}`, this.marks);
      mark.dataset.time = time;
      mark.addEventListener("click", () => this.showTime(time));
    }
    this.plots.replaceChildren();
    this.charts = chartsOf(this.replay).map((chart) =>
      new Chart(chart, this.plots, (time_s) => this.showTime(Math.round(1000 * time_s))));
    this.show(0, false);
  }

  showTime(time) {
    this.show(placeOf(this.replay.times, time), true);
  }

  show(place, isNamed) {
    this.place = place;
    this.slider.value = place;
    this.draw();
    this.describe();
    this.charts.forEach((chart) => chart.draw(this.replay.times[place] / 1000));
    if (isNamed) {
      const time = this.replay.times[place];
      history.replaceState(null, "", `#run=${this.number}&replay=${this.which}&time=${time}`);
    }
  }

  togglePlay() {
    if (this.timer) {
      clearInterval(this.timer);
      this.timer = undefined;
    } else {
      this.timer = setInterval(() => this.show((this.place + 1) % this.replay.times.length, false), 50);
    }
    this.button.textContent = this.timer ? "pause" : "play";
  }

  describe() {
    const { replay, place } = this;
    const ball = replay.ball[place];
    const lines = [`${replay.name}: ${(replay.times[place] / 1000).toFixed(3)} s`, whereInLog(replay, place)];
    const decision = replay.decisions[place];
    if (decision) {
      lines.push(`action ${decision[0]}, Q ${decision[1].toFixed(2)}, next best ${decision[2].toFixed(2)}`);
    }
    lines.push(ball ? `ball (${ball[0]}, ${ball[1]}) mm` : "ball not seen");
    replay.robots.forEach((path, robot) => {
      const pose = path[place];
      lines.push(pose ? `robot ${robot} (${pose[0]}, ${pose[1]}) mm, ${pose[2]} deg` : `robot ${robot} not seen`);
    });
    this.state.textContent = lines.join("\n");
  }

  draw() {
    const { canvas, replay, place } = this;
    const context = canvas.getContext("2d");
    const scale = drawField(context);
    const style = getComputedStyle(document.documentElement);
    const colours = [style.getPropertyValue("--robot"), style.getPropertyValue("--other")];
    const recent = (path) => path.slice(Math.max(0, place - 40), place + 1);  // two seconds
    drawTrail(context, recent(replay.ball), style.getPropertyValue("--ball"));
    replay.robots.forEach((path, robot) => {
      const colour = colours[replay.robots.length > 1 && robot < 5 ? 1 : 0];
      if (replay.robots.length === 1) {
        drawTrail(context, recent(path), colour);
      }
      if (path[place]) {
        drawRobot(context, path[place], colour, scale);
      }
    });
    if (replay.ball[place]) {
      drawBall(context, replay.ball[place], style.getPropertyValue("--ball"));
    }
  }
}

// Where the log tells what is shown.
function whereInLog({ log, lines, times }, place) {
  if (lines.length > 0) {
    return `${log} line ${lines[place]}`;
  }
  return `${log} at (${(times[place] / 1000).toFixed(6).padStart(17, "0")})`;
}

// What a replay plots over its time, as charts; Q where there are decisions.
function chartsOf({ times, plots, decisions }) {
  const x = times.map((time) => time / 1000);
  const charts = plots.map(({ y, series }) =>
    ({ x: "time, s", y, series: series.map(({ name, values, dashed }) => ({ name, x, y: values, dashed })) }));
  const at = decisions.map((decision, place) => (decision ? place : -1)).filter((place) => place >= 0);
  if (at.length > 0) {
    charts.push({ x: "time, s", y: "Q, units of reward", series: ["Q of the action", "Q of the next best"].map((name, which) =>
      ({ name, x: at.map((place) => x[place]), y: at.map((place) => decisions[place][which + 1]), dashed: which === 1 })) });
  }
  return charts;
}

function addTable(table, view, parent) {
  element("h3", table.name, parent);
  const box = element("div", undefined, parent);
  box.className = "scroll";
  const made = element("table", undefined, box);
  const head = element("tr", undefined, made);
  table.columns.forEach((column) => element("th", column, head));
  for (const row of table.rows) {
    const line = element("tr", undefined, made);
    row.forEach((value) => element("td", value, line));
    if (table.replay !== null && view) {
      line.dataset.replay = row[table.replay];
      line.addEventListener("click", () => {
        view.choose(row[table.replay]);
        view.show(0, true);
        view.canvas.scrollIntoView({ behavior: "smooth" });
      });
    }
  }
}

const views = runs.map((run, number) => {
  const section = element("section", undefined, document.getElementById("runs"));
  element("h2", run.title, section);
  run.notices.forEach((notice) => {
    element("p", notice, section).className = "notice";
  });
  const facts = element("ul", undefined, section);
  facts.className = "facts";
  run.facts.forEach(([name, value]) => element("li", `${name}: ${value}`, facts));
  const view = run.replays.length > 0 ? new Replay(run, number, section) : undefined;
  run.charts.forEach((chart) => {
    element("h3", chart.name, section);
    new Chart(chart, section);
  });
  run.tables.forEach((table) => addTable(table, view, section));
  return view;
});

function openMoment() {
  const wanted = new URLSearchParams(location.hash.slice(1));
  const view = views[Number(wanted.get("run") ?? -1)];
  const which = Number(wanted.get("replay") ?? view?.which);
  if (view && view.has(which)) {
    view.choose(which);
    view.showTime(Number(wanted.get("time") ?? 0));
  }
}

addEventListener("hashchange", openMoment);
openMoment();
document.getElementById("summary").textContent =
  `${runs.length} runs. Move a slider, or click a plot, an event or an episode; the address keeps the moment.`;
// For `chromium --headless --dump-dom`: from the page's beginning to here.
document.documentElement.dataset.openedAfterMs = Math.round(performance.now());
