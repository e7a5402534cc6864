// The page of the three-axis scanner. Every number shown comes from `mobileLidar`, the generated code; the matrices below
// only draw, with the errors exaggerated.
"use strict";
const ARCSEC = Math.PI / 648000;
const CHAIN = [
  ["outer", "Outer frame", [["dtheta_y1", "Ry"], ["dtheta_x1", "Rx"], ["alpha", "Rz"], ["dx1", "Tx"], ["dy1", "Ty"], ["dz1", "Tz"], ["da1", "Rx"], ["db1", "Ry"]]],
  ["middle", "Middle frame", [["delta_x2", "Tx"], ["delta_y2", "Ty"], ["dtheta_y2", "Ry"], ["dtheta_z2", "Rz"], ["beta", "Rx"], ["dx2", "Tx"], ["dy2", "Ty"], ["dz2", "Tz"], ["db2", "Ry"], ["dg2", "Rz"]]],
  ["inner", "Inner frame", [["delta_y3", "Ty"], ["dtheta_y3", "Ry"], ["dtheta_x3", "Rx"], ["gamma", "Rz"], ["dx3", "Tx"], ["dy3", "Ty"], ["dz3", "Tz"], ["da3", "Rx"], ["db3", "Ry"]]],
  ["device", "Device", [["dx4", "Tx"], ["dy4", "Ty"], ["dz4", "Tz"], ["da4", "Rx"], ["db4", "Ry"], ["dg4", "Rz"]]],
];
const JOINTS = { alpha: "α", beta: "β", gamma: "γ" };
const GREEK = { dtheta: "Δθ", delta: "δ", da: "Δα", db: "Δβ", dg: "Δγ", dx: "Δx", dy: "Δy", dz: "Δz" };
const element = (id) => document.getElementById(id);
const symbol = (name) => {
  const [, stem, rest] = /^(dtheta|delta|da|db|dg|dx|dy|dz)_?(.*)$/.exec(name);
  return `${GREEK[stem]}${rest}`;
};
const errorsOf = (factors) => factors.filter(([name]) => !(name in JOINTS));
const ALL = CHAIN.flatMap(([, , factors]) => errorsOf(factors));
const isAngle = (kind) => kind[0] === "R";

// The state is degrees, seconds of arc and millimetres; the address holds what is not zero, so that a link shows it.
const state = { alpha: 35, beta: 50, gamma: 0, view: -60 };
for (const [name] of ALL) state[name] = 0;
Object.assign(state, { da1: 20, dtheta_y1: 15, db2: -10, delta_x2: 0.2 });

function readAddress() {
  const given = new URLSearchParams(location.hash.slice(1));
  if ([...given.keys()].length === 0) return;
  for (const [name] of ALL) state[name] = 0;
  for (const [name, value] of given) if (name in state && Number.isFinite(Number(value))) state[name] = Number(value);
}

function writeAddress() {
  const names = Object.keys(state).filter((name) => state[name] !== 0 && name !== "view");
  history.replaceState(null, "", `#${names.map((name) => `${name}=${state[name]}`).join("&")}`);
}

function modelErrors(times = 1) {
  const errors = {};
  for (const [name, kind] of ALL) errors[name] = state[name] * times * (isAngle(kind) ? ARCSEC : 1e-3);
  return errors;
}
const modelJoints = () => ({ alpha: rad(state.alpha), beta: rad(state.beta), gamma: rad(state.gamma) });
const rad = (deg) => (deg * Math.PI) / 180;
const length = (v) => Math.hypot(...v);

// 3 x 4 transforms for the drawing: rotation rows and shift.
const identity = () => [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]];
function factor(kind, amount) {
  const m = identity();
  const axis = "xyz".indexOf(kind[1]);
  if (kind[0] === "T") {
    m[axis][3] = amount;
    return m;
  }
  const [c, s, i, j] = [Math.cos(amount), Math.sin(amount), (axis + 1) % 3, (axis + 2) % 3];
  m[i][i] = c; m[i][j] = -s; m[j][i] = s; m[j][j] = c;
  return m;
}
const times = (a, b) => a.map((row) => [0, 1, 2, 3].map((k) => row[0] * b[0][k] + row[1] * b[1][k] + row[2] * b[2][k] + (k === 3 ? row[3] : 0)));
const apply = (m, p) => m.map((row) => row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]);
function frames(exaggerate) {
  const joints = modelJoints();
  const errors = modelErrors(exaggerate);
  // Drawn in units of a tenth of a metre: shifts of millimetres, exaggerated, stay within the picture.
  let at = identity();
  return CHAIN.map(([, , factors]) => {
    for (const [name, kind] of factors) at = times(at, factor(kind, name in joints ? joints[name] : errors[name] * (isAngle(kind) ? 1 : 0.05)));
    return at;
  });
}

function draw() {
  const exaggerate = Number(element("exaggerate").value);
  const [outer, middle, inner, device] = frames(exaggerate);
  const [cv, sv] = [Math.cos(rad(state.view)), Math.sin(rad(state.view))];
  const flat = ([x, y, z]) => [90 * (cv * x - sv * y), -90 * (0.35 * (sv * x + cv * y) + 0.94 * z)];
  const path = (m, points, close) => points.map((p, i) => `${i ? "L" : "M"}${flat(apply(m, p)).map((v) => v.toFixed(1)).join(" ")}`).join("") + (close ? "Z" : "");
  const rectangle = (w, h) => [[-w, 0, -h], [w, 0, -h], [w, 0, h], [-w, 0, h]];
  const ring = (r) => Array.from({ length: 37 }, (_, i) => [r * Math.cos((i * Math.PI) / 18), r * Math.sin((i * Math.PI) / 18), 0]);
  const nominal = frames(0)[3];
  const parts = [
    [identity(), [[-0.5, 0, -1.3], [0.5, 0, -1.3]], "var(--soft)", 6],
    [outer, rectangle(1.05, 1.2), "var(--soft)", 4, true],
    [middle, ring(0.85), "var(--effect)", 4, true],
    [middle, [[-1.05, 0, 0], [1.05, 0, 0]], "var(--effect)", 2],
    [inner, ring(0.55), "var(--found)", 4, true],
    [device, [[-0.15, -0.15, 0], [0.15, -0.15, 0], [0.15, 0.15, 0], [-0.15, 0.15, 0]], "var(--ink)", 3, true],
    [nominal, [[0, 0, 0], [0, 0, 1.5]], "var(--after)", 2, false, "4 4"],
    [device, [[0, 0, 0], [0, 0, 1.5]], "var(--before)", 3],
  ];
  element("picture").innerHTML = parts.map(([m, points, colour, width, close, dash]) =>
    `<path d="${path(m, points, close)}" fill="none" stroke="${colour}" stroke-width="${width}"${dash ? ` stroke-dasharray="${dash}"` : ""}/>`).join("") +
    `<text x="-145" y="-136" font-size="11" fill="var(--before)">— beam</text><text x="-145" y="-122" font-size="11" fill="var(--after)">- - beam without errors</text>`;
}

function row(words, v, scale) {
  const numbers = [...v, length(v)].map((value) => {
    const told = value * scale;
    const small = told !== 0 && Math.abs(told) < 0.01;
    return `<td data-value="${value}">${small ? told.toExponential(1) : told.toFixed(3)}</td>`;
  });
  return `<tr><td>${words}</td>${numbers.join("")}</tr>`;
}

function show() {
  const model = mobileLidar;
  const joints = modelJoints();
  const errors = modelErrors();
  const exact = model.exactError(model.prepareExactError(errors), joints);
  const first = model.firstOrderError(model.prepareFirstOrderError(errors), joints);
  for (const [name, scale] of [["pointing", 1 / ARCSEC], ["position", 1e3]]) {
    const rest = exact[name].map((value, i) => value - first[name][i]);
    element(name).innerHTML = row("exact", exact[name], scale) + row("first order", first[name], scale) + row("difference", rest, scale);
  }
  const sum = ALL.filter(([, kind]) => isAngle(kind)).reduce((total, [name]) => total + Math.abs(errors[name]), 0);
  element("bound").innerHTML = `Proven for every pose (lesson 8): the difference is never more than ½(Σ|ε|)² = <span data-value="${(sum * sum) / 2}">${((sum * sum) / 2 / ARCSEC).toExponential(1)}″</span>.`;
  drawMap(model, errors);
  draw();
  for (const name of Object.keys(state)) {
    const input = element(name);
    if (!input) continue;
    input.value = state[name];
    const out = element(`${name}-out`);
    const kind = ALL.find(([error]) => error === name)?.[1];
    out.textContent = kind ? `${state[name]}${isAngle(kind) ? "″" : " mm"}` : `${state[name]}°`;
  }
  writeAddress();
}

function drawMap(model, errors) {
  const prepared = model.prepareExactError(errors);
  const canvas = element("map");
  const context = canvas.getContext("2d");
  const [columns, rows] = [72, 36];
  const cells = [];
  for (let j = 0; j < rows; j += 1) {
    for (let i = 0; i < columns; i += 1) {
      const joints = { alpha: rad(-180 + (i + 0.5) * 5), beta: rad(180 - (j + 0.5) * 10), gamma: rad(state.gamma) };
      cells.push(length(model.exactError(prepared, joints).pointing));
    }
  }
  const most = Math.max(...cells);
  const [w, h] = [canvas.width / columns, canvas.height / rows];
  cells.forEach((cell, at) => {
    const share = most > 0 ? cell / most : 0;
    context.fillStyle = `hsl(${260 - 200 * share} 70% ${12 + 58 * share}%)`;
    context.fillRect((at % columns) * w, Math.floor(at / columns) * h, w + 1, h + 1);
  });
  const [x, y] = [((state.alpha + 180) / 360) * canvas.width, ((180 - state.beta) / 360) * canvas.height];
  context.strokeStyle = "#fff";
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(x - 8, y); context.lineTo(x + 8, y); context.moveTo(x, y - 8); context.lineTo(x, y + 8);
  context.stroke();
  element("map-words").textContent = `Between ${(Math.min(...cells) / ARCSEC).toFixed(2)}″ and ${(most / ARCSEC).toFixed(2)}″ over all poses of this map.`;
}

function slider(name, words, limit, step) {
  return `<label for="${name}"><span>${words}</span> <input type="range" id="${name}" min="${-limit}" max="${limit}" step="${step}"> <output id="${name}-out"></output></label>`;
}

readAddress();
element("joints").innerHTML = Object.entries(JOINTS).map(([name, greek]) => slider(name, `${greek} ${name}`, 180, 1)).join("");
element("errors").innerHTML = CHAIN.map(([id, words, factors]) =>
  `<details${id === "outer" ? " open" : ""}><summary>${words}</summary>${errorsOf(factors).map(([name, kind]) => slider(name, `${symbol(name)} <code>${name}</code>`, isAngle(kind) ? 60 : 0.5, isAngle(kind) ? 1 : 0.05)).join("")}</details>`).join("");
document.addEventListener("input", (event) => {
  if (event.target.id in state) state[event.target.id] = Number(event.target.value);
  show();
});
element("zero").addEventListener("click", () => { for (const [name] of ALL) state[name] = 0; show(); });
element("random").addEventListener("click", () => {
  for (const [name, kind] of ALL) state[name] = isAngle(kind) ? Math.round(40 * (Math.random() - 0.5)) : Math.round(10 * (Math.random() - 0.5)) / 20;
  show();
});
window.addEventListener("hashchange", () => { readAddress(); show(); });
show();
