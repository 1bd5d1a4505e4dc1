// SPDX-License-Identifier: Apache-2.0
// The field from above, for the report and the live view: places in mm, headings in degrees, x to the right, y up.
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

// Empties the canvas and draws the lines; what is drawn behind it is in the field's coordinates. Returns pixels a mm.
function drawField(context) {
  const { canvas } = context;
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
  return scale;
}

// Through all places that are known.
function drawTrail(context, path, colour) {
  context.beginPath();
  for (const place of path) {
    if (place) {
      context.lineTo(place[0], place[1]);
    }
  }
  context.strokeStyle = colour;
  context.stroke();
}

function drawBall(context, [x, y], colour) {
  context.beginPath();
  context.arc(x, y, 50, 0, 2 * Math.PI);
  context.fillStyle = colour;
  context.fill();
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
