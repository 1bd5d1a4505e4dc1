// SPDX-License-Identifier: Apache-2.0
// Draws `runs` (striker_runs.py). "#run=0&replay=3&time=1200" in the address opens a moment of the replay with that number;
// moving a slider writes it.
"use strict";

const field = { halfLength: 3900, halfWidth: 2325, goalHalfWidth: 500, goalBack: 4350 };

function element(name, text, parent) {
  const made = document.createElement(name);
  if (text !== undefined) {
    made.textContent = text === null ? "" : String(text);
  }
  parent?.append(made);
  return made;
}

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
    this.slider = element("input", undefined, parent);
    this.slider.type = "range";
    this.slider.setAttribute("aria-label", "time");
    this.button = element("button", "play", parent);
    this.state = element("div", undefined, parent);
    this.state.className = "state";
    this.state.id = `state${number}`;
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
    const lines = [`${replay.name}: ${(replay.times[place] / 1000).toFixed(3)} s`, replay.notes[place]];
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
    const scale = canvas.width / 9200;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.setTransform(scale, 0, 0, -scale, canvas.width / 2, canvas.height / 2);
    context.lineWidth = 1.5 / scale;
    context.strokeStyle = "#7a8a7a";
    context.strokeRect(-field.halfLength, -field.halfWidth, 2 * field.halfLength, 2 * field.halfWidth);
    for (const side of [-1, 1]) {
      const from = side < 0 ? -field.goalBack : field.halfLength;
      context.strokeRect(from, -field.goalHalfWidth, field.goalBack - field.halfLength, 2 * field.goalHalfWidth);
    }
    const style = getComputedStyle(document.documentElement);
    const colours = [style.getPropertyValue("--robot"), style.getPropertyValue("--other")];
    this.trail(context, replay.ball, style.getPropertyValue("--ball"));
    replay.robots.forEach((path, robot) => {
      const colour = colours[replay.robots.length > 1 && robot < 5 ? 1 : 0];
      if (replay.robots.length === 1) {
        this.trail(context, path, colour);
      }
      if (path[place]) {
        drawRobot(context, path[place], colour, scale);
      }
    });
    if (replay.ball[place]) {
      context.beginPath();
      context.arc(replay.ball[place][0], replay.ball[place][1], 50, 0, 2 * Math.PI);
      context.fillStyle = style.getPropertyValue("--ball");
      context.fill();
    }
  }

  // Of the last two seconds.
  trail(context, path, colour) {
    context.beginPath();
    for (let place = Math.max(0, this.place - 40); place <= this.place; ++place) {
      if (path[place]) {
        context.lineTo(path[place][0], path[place][1]);
      }
    }
    context.strokeStyle = colour;
    context.stroke();
  }
}

function drawRobot(context, [x, y, heading], colour, scale) {
  const side = 150;
  context.save();
  context.translate(x, y);
  context.rotate(heading * Math.PI / 180);
  context.fillStyle = colour;
  context.fillRect(-side / 2, -side / 2, side, side);
  context.beginPath();
  context.moveTo(0, 0);
  context.lineTo(side / 2, 0);
  context.strokeStyle = "white";
  context.lineWidth = 2 / scale;
  context.stroke();
  context.restore();
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
  `${runs.length} runs. Move a slider, or click an event or an episode; the address keeps the moment.`;
