// SPDX-License-Identifier: Apache-2.0
// The live page, with striker_field.js before it: shows the states that the run sends (sil/view/state_json.hpp), and sends what
// is pressed (sil/view/command.hpp).
"use strict";

const byId = (id) => document.getElementById(id);
const history_ms = 3000;
let hello;
let state;
let chosen = 0;
let trails = { ball: [], robots: [] };
let marks = [];      // where the ball was touched
let samples = [];    // wheels of the chosen robot, by tick
let earlier = [];    // states' ticks and counts of a second, for rates
let isDrawing = false;  // a browser that draws slowly leaves states out, and still reads them all

const socket = new WebSocket(`ws://${location.host}/live${location.search}`);

// The server closes the connection of whoever sends more than 40 commands at once and 20 a second (view_server.hpp). A key
// that is held down on a button asks for more: what is too much is not sent, and stops last of all.
let allowance = 30;
let asked_at = performance.now();

function sendText(text, isStop) {
  const now = performance.now();
  allowance = Math.min(30, allowance + (now - asked_at) * 15 / 1000);
  asked_at = now;
  if (socket.readyState === WebSocket.OPEN && allowance >= (isStop ? -8 : 1)) {
    allowance -= 1;
    socket.send(text);
  }
}

const send = (command) => sendText(JSON.stringify(command), command.do === "stop");

socket.addEventListener("open", () => { byId("ended").textContent = ""; });
socket.addEventListener("close", () => {
  if (!byId("ended").textContent) {
    byId("ended").textContent = "the connection is lost";
  }
  document.querySelectorAll("button, select.time").forEach((control) => { control.disabled = true; });
});
socket.addEventListener("message", (event) => {
  const message = JSON.parse(event.data);
  if (message.hello) {
    begin(message.hello);
  } else if (message.state) {
    take(message.state);
  } else if (message.ended !== undefined) {
    byId("ended").textContent = `The run has ended: ${message.ended}`;
  }
});

function begin(told) {
  hello = told;
  byId("title").textContent = `Striker live: ${hello.scenario} ${hello.teams.join(" against ")}`;
  document.querySelectorAll(".time").forEach((control) => { control.disabled = !hello.has_time; });
  byId("stopOne").hidden = hello.scenario === "kick";
  byId("faults").replaceChildren();
  for (const kind of hello.faults) {
    const button = element("button", kind, byId("faults"));
    button.dataset.fault = kind;
    button.addEventListener("click", () => beginFault(kind));
  }
}

function beginFault(kind) {
  if (byId("faultMs").reportValidity()) {
    send({ do: "fault", robot: chosen, kind, ms: Number(byId("faultMs").value) });
  }
}

// A seed has 64 bits, a number of this language 53: it stays text.
function restart() {
  const field = byId("seed");
  const isSeed = /^\d{1,20}$/.test(field.value) && BigInt(field.value) < 2n ** 64n;
  field.setCustomValidity(isSeed ? "" : "a whole number from 0 to 18446744073709551615");
  if (field.reportValidity()) {
    sendText(`{"do":"restart","seed":${BigInt(field.value)}}`);
  }
}

function forget() {
  trails = { ball: [], robots: state.robots.map(() => []) };
  marks = [];
}

function take(next) {
  const isNewRun = !state || next.run !== state.run;
  const isElsewhere = isNewRun || next.episode !== state.episode || next.tick < state.tick;
  state = next;
  if (isNewRun) {
    byId("seed").value = state.seed;
    chooseFrom(state.robots.length);
    samples = [];
    earlier = [];
  }
  if (isElsewhere) {
    forget();
  }
  remember();
  if (!isDrawing) {
    isDrawing = true;
    requestAnimationFrame(draw);
  }
}

function chooseFrom(count) {
  const list = byId("robot");
  list.replaceChildren();
  for (let robot = 0; robot < count; ++robot) {
    const team = hello.teams.length > 0 ? ["red", "blue"][robot < 5 ? 0 : 1] : "";
    element("option", `${robot} ${team}`, list).value = robot;
  }
  chosen = Math.min(chosen, count - 1);
  list.value = chosen;
}

// What the page shows of the past: two seconds of trails, three of wheels, one of frames.
function remember() {
  const keep = (path, place) => {
    path.push([place[0], place[1], state.tick]);
    while (state.tick - path[0][2] > 2000) {
      path.shift();
    }
  };
  keep(trails.ball, state.ball);
  state.robots.forEach((robot, number) => keep(trails.robots[number], robot.pose));
  if (state.match) {
    state.match.touching.forEach((robot) => marks.push([...state.robots[robot].pose.slice(0, 2), state.tick]));
    marks = marks.filter((mark) => state.tick - mark[2] <= 2000);
  } else {
    marks = state.contact ? [state.contact] : [];
  }
  const last = samples.length > 0 ? samples[samples.length - 1][0] : -1;
  samples.push(...state.robots[chosen].wheels.filter((sample) => sample[0] > last));
  samples = samples.filter((sample) => state.tick - sample[0] <= history_ms);
  earlier.push({ tick: state.tick, counts: state.robots.map((robot) => robot.counts) });
  while (earlier.length > 2 && state.tick - earlier[1].tick >= 1000) {
    earlier.shift();
  }
}

function draw() {
  isDrawing = false;
  drawScene();
  showGame();
  showFacts();
  showDecision();
  showBus();
  const context = byId("speeds").getContext("2d");
  plot(context, [[1, "--other", 1], [2, "--robot", 1], [3, "--other", 3], [4, "--robot", 3]], 500);
  plot(byId("torques").getContext("2d"), [[5, "--other", 2], [6, "--robot", 2]], 50);
  byId("note").textContent = state.note[1];
  byId("pause").textContent = state.paused ? "Run" : "Pause";
}

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name);

function drawScene() {
  const context = byId("field").getContext("2d");
  const scale = drawField(context);
  if (state.target) {
    drawTarget(context, state.target);
  }
  drawTrail(context, trails.ball, colour("--ball"));
  state.robots.forEach((robot, number) => {
    const own = colour(hello.teams.length > 0 && number < 5 ? "--other" : "--robot");
    drawTrail(context, trails.robots[number], own);
    drawRobot(context, robot.pose, own, scale);
  });
  context.strokeStyle = colour("--mark");
  context.lineWidth = 3 / scale;
  for (const [x, y] of marks) {
    ring(context, x, y, 90);
  }
  const { pose, order } = state.robots[chosen];
  ring(context, pose[0], pose[1], 150);
  if (order && state.match) {
    drawTrail(context, [pose, order], colour("--mark"));
    ring(context, order[0], order[1], 40);
  }
  drawBall(context, state.ball, colour("--ball"));
}

function ring(context, x, y, radius) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.stroke();
}

// The ball is to go where the robot looked at the first decision.
function drawTarget(context, [x, y, heading]) {
  const angle = heading * Math.PI / 180;
  const ahead = (far) => [x + far * Math.cos(angle), y + far * Math.sin(angle)];
  context.setLineDash([60, 60]);
  drawTrail(context, [[x, y], ahead(3000)], colour("--mark"));
  context.setLineDash([]);
  ring(context, ...ahead(3000), 80);
}

const seconds = (ms) => (ms / 1000).toFixed(3);

function showGame() {
  const { match } = state;
  byId("game").textContent = match
    ? `${hello.teams[0]} ${match.score[0]} : ${match.score[1]} ${hello.teams[1]}, half ${match.half}, ` +
      `${seconds(match.clock)} s: ${match.state}${match.owner ? ` of ${match.owner}` : ""}` +
      `${match.sent_out.length > 0 ? `, sent out: ${match.sent_out.join(", ")}` : ""}`
    : `episode ${state.episode}, seed ${state.seed}${state.contact ? ", contact" : ""}`;
}

function showList(list, rows) {
  list.replaceChildren();
  for (const [name, value] of rows) {
    element("dt", name, list);
    element("dd", value, list);
  }
}

function showFacts() {
  const robot = state.robots[chosen];
  const [x, y, heading] = robot.pose;
  const timing = robot.timing_us ?? {};
  const us = (value) => (value === null || value === undefined ? "not measured" : `${value} us`);
  showList(byId("facts"), [
    ["time", `${seconds(state.tick)} s${state.paused ? ", paused" : ""}`],
    ["speed", !hello.has_time ? "the wall clock's" : state.speed === 0 ? "as fast as it goes" : `${state.speed} x, at most ${seconds(state.lateness_us)} ms late`],
    ["state", robot.state ?? "nothing heard"],
    ["fault", `${robot.fault ?? ""}${robot.faults && robot.faults.length > 1 ? ` (${robot.faults.join(", ")})` : ""}`],
    ["place", `(${x}, ${y}) mm, ${heading} deg, ${robot.speed} mm/s`],
    ["controller's tick", `late ${us(timing.lateness)}, takes ${us(timing.execution)}, ${timing.overruns ?? "none known"} missed`],
    ["frames ignored", robot.ignored ? `length ${robot.ignored[0]}, CRC ${robot.ignored[1]}, counter ${robot.ignored[2]}, range ${robot.ignored[3]}` : ""],
    ["gate", robot.blocked === undefined ? "" : `${robot.blocked} commands held back, ${robot.lost} frames lost`],
  ]);
}

function showDecision() {
  const { decision, q } = state.robots[chosen];
  const table = byId("q");
  table.replaceChildren();
  if (!decision) {
    byId("decision").textContent = "none heard";
    return;
  }
  byId("decision").textContent = `number ${decision.number}, action ${decision.action}, Q ${decision.best_q.toFixed(2)}, ` +
    `next best ${decision.next_q.toFixed(2)}${decision.extrapolated ? ", without a picture" : ""}`;
  if (!q) {
    return;
  }
  const least = Math.min(...q);
  const range = Math.max(...q) - least || 1;
  q.forEach((value, action) => {
    const row = element("tr", undefined, table);
    row.className = action === decision.action ? "best" : "";
    const wheels = hello.actions[action];
    element("td", `${action}: ${wheels[0]}, ${wheels[1]} mm/s`, row);
    element("td", value.toFixed(2), row);
    const bar = element("div", undefined, element("td", undefined, row));
    bar.className = "bar";
    bar.style.width = `${(100 * (value - least)) / range}%`;
  });
}

// Over the last second of simulated time. The load takes each frame as long as its longest, and leaves out lockstep's
// own, which are on no real robot's bus.
function showBus() {
  const first = earlier[0];
  const passed_s = (state.tick - first.tick) / 1000;
  const table = byId("bus");
  table.replaceChildren();
  if (passed_s <= 0) {
    return;
  }
  const head = element("tr", undefined, table);
  ["message", "frames/s", "share of the bus"].forEach((name) => element("th", name, head));
  let load = 0;
  hello.messages.forEach((message, kind) => {
    const counts = [first.counts[chosen][kind], state.robots[chosen].counts[kind]];
    const rate = (counts[1] - counts[0]) / passed_s;
    const share = message.lockstep ? 0 : (rate * message.bits) / hello.bit_rate;
    load += share;
    if (counts[1] > 0) {
      const row = element("tr", undefined, table);
      element("td", message.name, row);
      element("td", rate.toFixed(0), row);
      element("td", message.lockstep ? "lockstep" : `${(100 * share).toFixed(1)} %`, row);
    }
  });
  byId("load").textContent = `at most ${(100 * load).toFixed(1)} % of ${hello.bit_rate / 1e6} Mbit/s`;
}

// Lines over the last three seconds; `least` is the smallest range to either side.
function plot(context, lines, least) {
  const { canvas } = context;
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, canvas.width, canvas.height);
  const most = Math.max(least, ...samples.flatMap((sample) => lines.map(([column]) => Math.abs(sample[column]))));
  const x = (tick) => canvas.width * (1 - (state.tick - tick) / history_ms);
  const y = (value) => canvas.height * (0.5 - 0.48 * value / most);
  context.fillStyle = context.strokeStyle = getComputedStyle(document.body).color;
  context.lineWidth = 0.5;
  context.strokeRect(0, y(0), canvas.width, 0);
  context.font = "20px system-ui";
  context.fillText(`${most}`, 4, 20);
  context.fillText(`${-most}`, 4, canvas.height - 6);
  context.fillText("3 s ago; left is orange, right is blue", 90, canvas.height - 6);
  for (const [column, name, width] of lines) {
    context.beginPath();
    samples.forEach((sample) => context.lineTo(x(sample[0]), y(sample[column])));
    context.strokeStyle = colour(name);
    context.lineWidth = width;
    context.stroke();
  }
}

byId("pause").addEventListener("click", () => send({ do: state && state.paused ? "run" : "pause" }));
byId("step").addEventListener("click", () => send({ do: "step", ticks: 1 }));
byId("stepDecision").addEventListener("click", () => send({ do: "step", ticks: 50 }));
byId("speed").addEventListener("change", () => {
  const { value } = byId("speed");
  send({ do: "speed", x: value === "max" ? value : Number(value) });
});
byId("restart").addEventListener("click", restart);
byId("stop").addEventListener("click", () => send({ do: "stop" }));
byId("stopOne").addEventListener("click", () => send({ do: "stop", robot: chosen }));
byId("robot").addEventListener("change", () => {
  chosen = Number(byId("robot").value);
  samples = [];
});
