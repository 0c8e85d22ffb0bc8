/* The figure of a material: e_z and e_x over speed and angle, from the table that tables.py made.
 * SPDX-License-Identifier: BSD-3-Clause */
"use strict";

/* ---- The table, docs/site/tables.py ---- */

/* Cubic through the four values around place u; linear below four values. at(i) is value i. */
function cubic(at, count, u) {
  if (count < 4) return at(0);
  const i = Math.min(Math.max(Math.floor(u), 1), count - 3), x = u - i;
  return (-x * (x - 1) * (x - 2) / 6) * at(i - 1) + ((x * x - 1) * (x - 2) / 2) * at(i)
    - (x * (x + 1) * (x - 2) / 2) * at(i + 1) + (x * (x * x - 1) / 6) * at(i + 2);
}

/* t(y), docs/table.md. */
function place(y) {
  const c = 2e-4;
  return 0.5 + (y - 0.5) * (1 + Math.pow(c, 0.25) - Math.pow(y * (1 - y) + c, 0.25));
}

/* null in the table is not finite: the cubic beside it is NaN. */
function number(value) {
  return value === null ? NaN : value;
}

/* Everything about one impact: {radius, density, speed, friction, angle} in SI units and degrees. */
function evaluate(table, impact) {
  const slope = Math.tan(impact.angle * Math.PI / 180);
  const normal = impact.speed * Math.cos(impact.angle * Math.PI / 180);
  const strain = Math.pow(table.compliance * impact.density * normal * normal, 0.2);
  const time = impact.radius / normal * strain * strain;
  const [low, high, count] = table.log_time;
  const u = Math.min(Math.max((Math.log(time) - low) / Math.max(high - low, 1e-300), 0), 1) * (count - 1);
  const along = (row) => cubic((i) => number(table[row][i]), count, u);
  const surface = (panel, v) => cubic(
    (i) => cubic((j) => table[panel][i][j], table[panel][i].length, v * (table[panel][i].length - 1)), count, u);
  const ez = along("ez"), psi = table.kappa * slope / impact.friction;
  const most = 2 * table.chi * (1 + ez) - ez;
  let ex;
  if (psi <= 1) ex = surface("stick", psi);
  else if (psi < most) {
    const y = (psi - 1) / (most - 1);
    ex = (surface("slip", place(y)) + y * ez) / psi;
  } else ex = 2 * table.chi * (1 + ez) / psi - 1;
  const result = {
    ez, ex, psi, normal,
    contact_time: time * Math.exp(along("contact")),
    radius_ratio: strain * Math.exp(along("radius")),
    speed_ratio: normal / Math.exp(along("wave")) * Math.sqrt(table.density ? 1 : impact.density),
    displacement_ratio: slope * strain * Math.exp(along("depth")),
  };
  result.passed = [];
  if (!(result.radius_ratio <= table.limits.radius)) result.passed.push("radius");
  if (!(result.speed_ratio <= table.limits.speed)) result.passed.push("speed");
  if (!(result.displacement_ratio <= table.limits.displacement)) result.passed.push("displacement");
  if (table.window && !(result.contact_time >= table.window[0] && result.contact_time <= table.window[1])) {
    result.passed.push("window");
  }
  return result;
}

/* ---- The page ---- */

const SLIDERS = [
  { key: "radius", label: "Radius of the ball", unit: "mm", scale: 1e3, step: 0, start: 5e-3 },
  { key: "speed", label: "Speed", unit: "m/s", scale: 1, step: 0, start: 0.1 },
  { key: "angle", label: "Angle to the normal", unit: "degrees", scale: 1, step: 1, start: 30 },
  { key: "friction", label: "Friction coefficient", unit: "", scale: 1, step: 0.01, start: 0.3 },
];
const STEPS = 200; /* of a logarithmic slider, which has no step of its own */
const WORDS = {
  radius: "The contact is not small against the ball",
  speed: "The impact is not slow against shear waves",
  displacement: "The slide is long against the contact",
  window: "The material was not measured at this contact time",
};

function rounded(value, digits) {
  return Number.isFinite(value) ? String(Number(value.toPrecision(digits))) : "–";
}

function element(tag, attributes, ...children) {
  const svg = ["svg", "path", "line", "text", "rect", "circle", "g", "pattern", "defs", "title", "tspan"];
  const node = svg.includes(tag) ? document.createElementNS("http://www.w3.org/2000/svg", tag)
    : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) node.setAttribute(name, value);
  node.append(...children);
  return node;
}

/* A slider's last place; the value of a place, as shown; and the place of a value. */
function lastOf(slider, range) {
  return slider.step ? Math.round((range[1] - range[0]) / slider.step) : STEPS;
}

function valueAt(slider, range, place) {
  if (slider.step) return Number((range[0] + slider.step * place).toFixed(4));
  return Number((range[0] * Math.pow(range[1] / range[0], place / STEPS)).toPrecision(2));
}

function placeOf(slider, range, value) {
  if (slider.step) return Math.round((value - range[0]) / slider.step);
  return Math.round(STEPS * Math.log(value / range[0]) / Math.log(range[1] / range[0]));
}

/* The balls: of the material where its density is known, and a rigid one of steel. */
function balls(table) {
  const list = [["steel", "rigid ball of steel (7800 kg/m³), wall of this material", 7800],
    ["glass", "rigid ball of glass (2500 kg/m³), wall of this material", 2500]];
  if (table.density) {
    list.unshift(["own", `ball of this material (${table.density} kg/m³), rigid wall`, table.density]);
  }
  return list;
}

function controls(table, state, changed) {
  const box = element("div", { class: "impact-controls" });
  const select = element("select", { id: "impact-ball" });
  for (const [key, words, density] of balls(table)) {
    select.append(element("option", { value: key, "data-density": density }, words));
  }
  const choose = () => { state.density = Number(select.selectedOptions[0].dataset.density); };
  select.addEventListener("change", () => { choose(); changed(); });
  choose();
  box.append(element("div", { class: "impact-control impact-wide" },
    element("label", { for: "impact-ball" }, "Ball and wall"), select));
  for (const slider of SLIDERS) {
    const range = table.ranges[slider.key], shown = element("output", { for: `impact-${slider.key}` });
    const input = element("input", { type: "range", id: `impact-${slider.key}`, min: 0, max: lastOf(slider, range), step: 1,
      value: placeOf(slider, range, slider.start) });
    const read = () => {
      state[slider.key] = valueAt(slider, range, Number(input.value));
      shown.textContent = `${rounded(state[slider.key] * slider.scale, 3)} ${slider.unit}`.trim();
      input.setAttribute("aria-valuetext", shown.textContent);
    };
    input.addEventListener("input", () => { read(); changed(); });
    read();
    box.append(element("div", { class: "impact-control" },
      element("label", { for: `impact-${slider.key}` }, slider.label), shown, input));
  }
  return box;
}

/* ---- Panels ---- */

const WIDTH = 420, HEIGHT = 300, LEFT = 46, RIGHT = 14, TOP = 30, BOTTOM = 46, LOW = -1, HIGH = 1.06;
const CURVES = [{ key: "ez", name: "e", sub: "z", class: "impact-ez" }, { key: "ex", name: "e", sub: "x", class: "impact-ex" }];

function toY(value) {
  return TOP + (HIGH - value) / (HIGH - LOW) * (HEIGHT - TOP - BOTTOM);
}

function axes(panel, svg) {
  const text = (x, y, words, more) => svg.append(element("text", { x, y, ...more }, words));
  for (const value of [-1, -0.5, 0, 0.5, 1]) {
    svg.append(element("line", { x1: LEFT, x2: WIDTH - RIGHT, y1: toY(value), y2: toY(value),
      class: value === 0 ? "impact-zero" : "impact-grid" }));
    text(LEFT - 6, toY(value) + 4, String(value).replace("-", "−"), { "text-anchor": "end" });
  }
  for (const [value, words] of panel.ticks) {
    const x = panel.toX(value);
    svg.append(element("line", { x1: x, x2: x, y1: TOP, y2: HEIGHT - BOTTOM, class: "impact-grid" }));
    text(x, HEIGHT - BOTTOM + 17, words, { "text-anchor": "middle" });
  }
  text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 8, panel.label, { "text-anchor": "middle" });
}

/* Rectangles over what passes a limit, and the number of samples in them. */
function shade(panel, svg, samples) {
  const step = samples.length > 1 ? panel.toX(samples[1].x) - panel.toX(samples[0].x) : 0;
  let begin = null;
  for (let i = 0; i <= samples.length; i++) {
    const passed = i < samples.length && samples[i].passed.length > 0;
    if (passed && begin === null) begin = i;
    if (!passed && begin !== null) {
      const x1 = Math.max(panel.toX(samples[begin].x) - (begin > 0 ? step / 2 : 0), LEFT);
      const x2 = Math.min(panel.toX(samples[i - 1].x) + (i < samples.length ? step / 2 : 0), WIDTH - RIGHT);
      svg.append(element("rect", { x: x1, y: TOP, width: Math.max(x2 - x1, 1), height: HEIGHT - TOP - BOTTOM,
        class: "impact-beyond", fill: `url(#impact-hatch-${panel.key})` }));
      begin = null;
    }
  }
}

function draw(panel, svg, table, state) {
  svg.replaceChildren();
  svg.append(element("title", {}, panel.title), element("defs", {}, element("pattern",
    { id: `impact-hatch-${panel.key}`, width: 8, height: 8, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
    element("rect", { width: 8, height: 8, class: "impact-hatch-ground" }),
    element("line", { x1: 0, y1: 0, x2: 0, y2: 8, class: "impact-hatch-line" }))));
  const samples = [];
  for (let i = 0; i <= 160; i++) {
    const x = panel.valueAt(i / 160);
    samples.push({ x, ...evaluate(table, { ...state, [panel.key]: x }) });
  }
  axes(panel, svg);
  shade(panel, svg, samples);
  for (const curve of CURVES) {
    const points = samples.filter((one) => Number.isFinite(one[curve.key]));
    const d = points.map((one, i) => `${i ? "L" : "M"}${panel.toX(one.x).toFixed(1)} ${toY(one[curve.key]).toFixed(1)}`);
    svg.append(element("path", { d: d.join(""), class: `impact-curve ${curve.class}` }));
  }
  const now = evaluate(table, state), x = panel.toX(state[panel.key]);
  svg.append(element("line", { x1: x, x2: x, y1: TOP, y2: HEIGHT - BOTTOM, class: "impact-now" }));
  for (const curve of CURVES) {
    svg.append(element("circle", { cx: x, cy: toY(now[curve.key]), r: 4.5, class: `impact-dot ${curve.class}` }));
  }
  CURVES.forEach((curve, i) => {
    const at = LEFT + 4 + 62 * i;
    svg.append(element("line", { x1: at, x2: at + 26, y1: 16, y2: 16, class: `impact-curve ${curve.class}` }),
      element("text", { x: at + 31, y: 20 }, curve.name, element("tspan", { dy: 4, "font-size": "75%" }, curve.sub)));
  });
}

function panelsOf(table) {
  const between = (x) => LEFT + x * (WIDTH - LEFT - RIGHT);
  const [slow, fast] = table.ranges.speed, [, steep] = table.ranges.angle, decades = [];
  for (let p = Math.ceil(Math.log10(slow)); p <= Math.floor(Math.log10(fast)); p++) {
    decades.push([Math.pow(10, p), String(Number(Math.pow(10, p).toPrecision(1)))]);
  }
  return [
    { key: "speed", title: "Restitution over the speed", label: "speed (m/s)", ticks: decades,
      valueAt: (x) => slow * Math.pow(fast / slow, x), toX: (v) => between(Math.log(v / slow) / Math.log(fast / slow)) },
    { key: "angle", title: "Restitution over the angle", label: "angle to the normal (degrees)",
      ticks: [0, 15, 30, 45, 60, 75].map((v) => [v, String(v)]), valueAt: (x) => x * steep, toX: (v) => between(v / steep) },
  ];
}

/* ---- Numbers ---- */

function numbers(box, table, state) {
  const now = evaluate(table, state), error = table.error;
  for (const key of ["radius", "density", "speed", "angle", "friction"]) box.dataset[key] = state[key];
  for (const key of ["ez", "ex", "contact_time", "radius_ratio", "speed_ratio", "displacement_ratio"]) {
    box.dataset[key] = now[key];
  }
  box.dataset.passed = now.passed.join(" ");
  const row = (name, value, passed) => element("tr", passed ? { class: "impact-passed" } : {},
    element("th", { scope: "row" }, ...name), element("td", {}, value));
  const sub = (letter, index) => [letter, element("sub", {}, index)];
  const rows = [
    row([...sub("e", "z"), ", normal restitution"], `${now.ez.toFixed(3)} ± ${rounded(error.ez, 1)}`),
    row([...sub("e", "x"), ", tangential restitution"],
      `${now.ex.toFixed(3).replace("-", "−")} ± ${rounded(error.ex, 1)}`),
    row(["contact time"], Number.isFinite(now.contact_time) ? `${rounded(now.contact_time * 1e3, 3)} ms` : "no rebound",
      now.passed.includes("window")),
    row(["contact radius / radius"], rounded(now.radius_ratio, 2), now.passed.includes("radius")),
    row(["normal speed / shear wave speed"], rounded(now.speed_ratio, 2), now.passed.includes("speed")),
    row(["slide / contact radius"], rounded(now.displacement_ratio, 2), now.passed.includes("displacement")),
  ];
  const words = now.passed.map((key) => WORDS[key]).join(". ");
  box.replaceChildren(element("table", {}, element("tbody", {}, ...rows)),
    element("p", { class: "impact-words" }, words ? `Beyond the limits: ${words}.` : "No limit of this table is passed."));
}

function start(root, table) {
  const state = {}, out = element("div", { class: "impact-numbers", id: "impact-numbers", role: "status", "aria-live": "polite" });
  const panels = panelsOf(table), figures = element("div", { class: "impact-panels" });
  for (const panel of panels) {
    panel.svg = element("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": `${panel.title}; the numbers stand in the table` });
    figures.append(panel.svg);
  }
  const changed = () => {
    numbers(out, table, state);
    for (const panel of panels) draw(panel, panel.svg, table, state);
  };
  root.replaceChildren(controls(table, state, changed), figures, out);
  changed();
}

if (typeof module !== "undefined") module.exports = { evaluate };
else start(document.getElementById("impact"), JSON.parse(document.getElementById("impact-table").textContent));
