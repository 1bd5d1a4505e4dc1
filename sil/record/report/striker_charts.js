// SPDX-License-Identifier: Apache-2.0
// Line charts on a canvas: axes with units, colours that colour-blind people tell apart, a level as a dotted line.
"use strict";

const colours = ["#0072b2", "#d55e00", "#009e73", "#e69f00", "#cc79a7", "#56b4e9", "#888888", "#b8a800"];
const margin = { left: 70, right: 12, top: 26, bottom: 34 };

// Some five round numbers in a range.
function ticksOf(low, high) {
  const rough = (high - low) / 5;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((candidate) => candidate >= rough);
  const ticks = [];
  for (let count = Math.ceil(low / step); count * step <= high + 1e-9 * step; ++count) {
    ticks.push(Number((count * step).toPrecision(12)));
  }
  return ticks;
}

function rangeOf(values) {
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    if (value !== null) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  if (!(low < high)) {
    const middle = Number.isFinite(low) ? low : 0;
    return [middle - 1, middle + 1];
  }
  const room = 0.05 * (high - low);
  return [low - room, high + room];
}

// {name, x, y, series: [{name, x, y, dashed}], levels: [[value, text]]}; `mark` is an x to draw a line at.
class Chart {
  constructor(chart, parent, chosen) {
    this.canvas = element("canvas", undefined, parent);
    this.canvas.className = "plot";
    this.canvas.width = 1200;
    this.canvas.height = 260;
    this.canvas.addEventListener("click", (event) => {
      const box = this.canvas.getBoundingClientRect();
      chosen?.(this.xAt((event.clientX - box.left) * this.canvas.width / box.width));
    });
    this.set(chart);
  }

  set(chart) {
    this.chart = chart;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", `${chart.y} over ${chart.x}: ${chart.series.map(({ name }) => name).join(", ")}`);
    this.x = rangeOf(chart.series.flatMap(({ x }) => [x[0] ?? null, x[x.length - 1] ?? null]));
    const levels = (chart.levels ?? []).map(([value]) => value);
    const ranges = chart.series.map(({ y }) => rangeOf(y));
    this.y = rangeOf([...ranges.flat(), ...levels]);
    this.draw();
  }

  xAt(pixel) {
    const share = (pixel - margin.left) / (this.canvas.width - margin.left - margin.right);
    return this.x[0] + share * (this.x[1] - this.x[0]);
  }

  place(x, y) {
    const { width, height } = this.canvas;
    return [margin.left + (x - this.x[0]) / (this.x[1] - this.x[0]) * (width - margin.left - margin.right),
            height - margin.bottom - (y - this.y[0]) / (this.y[1] - this.y[0]) * (height - margin.top - margin.bottom)];
  }

  line(context, points, colour, dash) {
    context.beginPath();
    let drawing = false;
    for (const [x, y] of points) {
      if (y === null) {
        drawing = false;
        continue;
      }
      context[drawing ? "lineTo" : "moveTo"](...this.place(x, y));
      drawing = true;
    }
    context.strokeStyle = colour;
    context.setLineDash(dash);
    context.stroke();
    context.setLineDash([]);
  }

  draw(mark) {
    const context = this.canvas.getContext("2d");
    const ink = getComputedStyle(document.body).color;
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    context.font = "13px system-ui, sans-serif";
    context.lineWidth = 1;
    this.axes(context, ink);
    context.lineWidth = 1.6;
    for (const [value, text] of this.chart.levels ?? []) {
      this.line(context, [[this.x[0], value], [this.x[1], value]], ink, [2, 4]);
      context.fillText(text, margin.left + 6, this.place(0, value)[1] - 4);
    }
    let left = margin.left;
    this.chart.series.forEach(({ name, x, y, dashed }, number) => {
      const colour = colours[number % colours.length];
      this.line(context, x.map((value, place) => [value, y[place]]), colour, dashed ? [5, 4] : []);
      context.fillStyle = colour;
      context.textAlign = "left";
      context.fillText(name, left, 16);
      left += context.measureText(name).width + 22;
    });
    if (mark !== undefined) {
      this.line(context, [[mark, this.y[0]], [mark, this.y[1]]], ink, []);
    }
  }

  axes(context, ink) {
    const { width, height } = this.canvas;
    context.fillStyle = ink;
    context.strokeStyle = "#8884";
    context.textAlign = "center";
    for (const x of ticksOf(...this.x)) {
      const [pixel] = this.place(x, this.y[0]);
      this.line(context, [[x, this.y[0]], [x, this.y[1]]], "#8883", []);
      context.fillText(String(x), pixel, height - margin.bottom + 14);
    }
    context.fillText(this.chart.x, (margin.left + width) / 2, height - 4);
    context.textAlign = "right";
    for (const y of ticksOf(...this.y)) {
      this.line(context, [[this.x[0], y], [this.x[1], y]], "#8883", []);
      context.fillText(String(y), margin.left - 6, this.place(this.x[0], y)[1] + 4);
    }
    context.save();
    context.translate(13, (height - margin.bottom + margin.top) / 2);
    context.rotate(-Math.PI / 2);
    context.textAlign = "center";
    context.fillText(this.chart.y, 0, 0);
    context.restore();
    context.textAlign = "left";
  }
}
