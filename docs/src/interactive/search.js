// Hide an effect, measure, search: the method of lesson 12 in small. Columns come from `mobileLidar`, the generated code.
"use strict";
const ARCSEC = Math.PI / 648000;
const element = (id) => document.getElementById(id);

// Where a rotation can sit, and which declared error or joint has its column.
const PLACES = [
  { joint: "alpha", greek: "α", rotations: [["Rx", "da1"], ["Ry", "db1"], ["Rz", "alpha"]] },
  { joint: "beta", greek: "β", rotations: [["Rx", "beta"], ["Ry", "db2"], ["Rz", "dtheta_z2"]] },
  { joint: "gamma", greek: "γ", rotations: [["Rx", "da3"], ["Ry", "db3"], ["Rz", "gamma"]] },
];
const PER_TURN = ["once", "twice", "three times"];
const CATALOGUE = PLACES.flatMap(({ joint, greek, rotations }) =>
  rotations.flatMap(([rotation, column]) =>
    [1, 2, 3].map((order) => ({
      joint, column, order,
      name: column === joint ? `encoder of ${greek}, ${PER_TURN[order - 1]} a turn` : `axis of ${greek} tilts about ${rotation[1]}, ${PER_TURN[order - 1]} a turn`,
    }))));

// Small random numbers with a seed, so that an address shows the same run (mulberry32 and Box-Muller).
function generator(seed) {
  let state = seed >>> 0;
  const uniform = () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
  return { uniform, normal: () => Math.sqrt(-2 * Math.log(1 - uniform())) * Math.cos(2 * Math.PI * uniform()) };
}

const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);

/** Columns made orthonormal, those that the earlier ones hold left out. */
function orthonormal(columns, basis = []) {
  const own = [];
  for (const column of columns) {
    let left = column.slice();
    for (const b of [...basis, ...own, ...basis, ...own]) {
      const share = dot(b, left);
      left = left.map((value, i) => value - share * b[i]);
    }
    const size = Math.sqrt(dot(left, left));
    if (size > 1e-6 * Math.sqrt(dot(column, column)) && size > 0) own.push(left.map((value) => value / size));
  }
  return own;
}

/** The columns of the first-order form at each pose: an array of 3 × poses numbers for each name. */
function columnsAt(poses) {
  const model = mobileLidar;
  const none = model.prepareFirstOrderJacobian(model.noErrors);
  const names = Object.keys(model.noErrors);
  const columns = Object.fromEntries([...names, "alpha", "beta", "gamma"].map((name) => [name, []]));
  const value = model.prepareExactValue(model.noErrors);
  for (const pose of poses) {
    const jacobian = model.firstOrderJacobian(none, pose).pointing;
    names.forEach((name, at) => columns[name].push(...jacobian.map((row) => row[at])));
    for (const joint of ["alpha", "beta", "gamma"]) {
      const step = 1e-5;
      const [more, less] = [1, -1].map((sign) => model.exactValue(value, { ...pose, [joint]: pose[joint] + sign * step }).pointing);
      columns[joint].push(...more.map((v, i) => (v - less[i]) / (2 * step)));
    }
  }
  return { columns, declared: names };
}

const blockOf = (candidate, columns, poses) => {
  const column = columns[candidate.column];
  return [Math.cos, Math.sin].map((f) => column.map((value, i) => value * f(candidate.order * poses[Math.floor(i / 3)][candidate.joint])));
};

function run({ effect, size, noise, rows, seed }) {
  const random = generator(seed);
  const turn = () => 2 * Math.PI * random.uniform() - Math.PI;
  const poses = Array.from({ length: rows }, () => ({ alpha: turn(), beta: turn(), gamma: turn() }));
  const { columns, declared } = columnsAt(poses);
  const hidden = CATALOGUE[effect];
  const phase = turn();
  const [c, s] = blockOf(hidden, columns, poses);
  const measured = c.map((value, i) => size * (value * Math.cos(phase) + s[i] * Math.sin(phase)) + noise * random.normal());
  const fitted = orthonormal(declared.map((name) => columns[name]));
  const project = (v) => fitted.reduce((left, b) => { const share = dot(b, left); return left.map((x, i) => x - share * b[i]); }, v);
  const residual = project(measured);
  const blocks = CATALOGUE.map((candidate) => orthonormal(blockOf(candidate, columns, poses), fitted));
  const explained = (r) => blocks.map((block) => (block.length < 2 ? 0 : block.reduce((sum, b) => sum + dot(b, r) ** 2, 0)));
  const own = explained(residual);
  const FLIPS = 199;
  // A flip changes the sign of a pose's three components together; the best candidate of each flip is what luck can do.
  const best = Array.from({ length: FLIPS }, () => {
    const signs = poses.map(() => (random.uniform() < 0.5 ? -1 : 1));
    return Math.max(...explained(project(residual.map((value, i) => value * signs[Math.floor(i / 3)]))));
  });
  const chance = (t) => (1 + best.filter((b) => b >= t).length) / (FLIPS + 1);
  const total = dot(residual, residual);
  const order = own.map((_, at) => at).sort((a, b) => own[b] - own[a]);
  const first = order[0];
  const overlap = (a, b) => Math.min(...blocks[a].map((x) => blocks[b].reduce((sum, y) => sum + dot(x, y) ** 2, 0)));
  const alike = order.filter((at) => at !== first && blocks[at].length === 2 && overlap(first, at) > 0.99);
  return { poses, columns, residual, total, own, order, first, alike, chance, hidden: effect, fitted, size };
}

function show(result, settings) {
  const found = result.chance(result.own[result.first]) <= 0.05;
  const nothing = settings.size === 0;
  const name = CATALOGUE[result.first].name;
  const right = result.first === result.hidden || result.alike.includes(result.hidden);
  element("verdict").textContent = found ? `Found: ${name}` : "Nothing found: what is left may be noise";
  element("verdict").style.color = found ? "var(--found)" : "var(--soft)";
  const judged = nothing ? (found ? "A false alarm: nothing was hidden." : "Right: nothing was hidden.")
    : found ? (right ? "That is what you hid." : `You hid: ${CATALOGUE[result.hidden].name}.`) : `You hid ${CATALOGUE[result.hidden].name}, too small to be seen here.`;
  const same = result.alike.length ? ` These poses cannot tell it from: ${result.alike.map((at) => CATALOGUE[at].name).join("; ")}.` : "";
  element("evidence").textContent = `${judged} Chance that the best of all ${CATALOGUE.length} candidates explains as much by luck: ${result.chance(result.own[result.first]).toFixed(3)}.${found ? same : ""}`;
  element("candidates").innerHTML = result.order.slice(0, 5).map((at) =>
    `<tr><td>${CATALOGUE[at].name}</td><td>${((100 * result.own[at]) / result.total).toFixed(1)} %</td><td>${result.chance(result.own[at]).toFixed(3)}</td></tr>`).join("");
  plot(result);
  document.body.dataset.found = found ? String(result.first) : "";
}

function plot({ poses, columns, residual, first, fitted }) {
  const candidate = CATALOGUE[first];
  const column = columns[candidate.column];
  const points = poses.map((pose, at) => {
    const [d, r] = [column, residual].map((v) => v.slice(3 * at, 3 * at + 3));
    const size = Math.hypot(...d);
    return [pose[candidate.joint], size > 0.2 ? dot(d, r) / size : null];
  }).filter(([, y]) => y !== null);
  const [c, s] = orthonormalFit(blockOf(candidate, columns, poses), residual, fitted);
  const curve = Array.from({ length: 121 }, (_, i) => { const q = -Math.PI + (i * Math.PI) / 60; return [q, c * Math.cos(candidate.order * q) + s * Math.sin(candidate.order * q)]; });
  const most = Math.max(1, ...points.map(([, y]) => Math.abs(y)));
  const place = ([q, y]) => [50 + ((q + Math.PI) / (2 * Math.PI)) * 650, 120 - (105 * y) / most];
  const ticks = [-180, -90, 0, 90, 180].map((deg) => { const [x] = place([(deg * Math.PI) / 180, 0]); return `<text x="${x}" y="248" font-size="13" text-anchor="middle" fill="currentColor">${deg}°</text>`; });
  const levels = [-most, 0, most].map((y) => { const [, at] = place([0, y]); return `<text x="44" y="${at + 4}" font-size="13" text-anchor="end" fill="currentColor">${y.toFixed(0)}″</text><path d="M50 ${at}H700" stroke="var(--line)"/>`; });
  element("plot").innerHTML = `${ticks.join("")}${levels.join("")}<g fill="var(--before)">${points.map((p) => { const [x, y] = place(p); return `<circle cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="3"/>`; }).join("")}</g>` +
    `<path d="${curve.map((p, i) => `${i ? "L" : "M"}${place(p).map((v) => v.toFixed(1)).join(" ")}`).join("")}" fill="none" stroke="var(--effect)" stroke-width="3"/>`;
}

/** Coefficients of two columns fitted beside the declared ones. */
function orthonormalFit(block, residual, fitted) {
  const project = (v) => fitted.reduce((left, b) => { const share = dot(b, left); return left.map((x, i) => x - share * b[i]); }, v);
  const [a, b] = block.map(project);
  const [aa, ab, bb, ar, br] = [dot(a, a), dot(a, b), dot(b, b), dot(a, residual), dot(b, residual)];
  const determinant = aa * bb - ab * ab;
  return determinant > 1e-9 * aa * bb ? [(ar * bb - br * ab) / determinant, (br * aa - ar * ab) / determinant] : [0, 0];
}

const given = new URLSearchParams(location.hash.slice(1));
element("effect").innerHTML = CATALOGUE.map((candidate, at) => `<option value="${at}">${candidate.name}</option>`).join("");
element("effect").value = given.get("effect") ?? "9";
for (const id of ["size", "noise", "rows"]) if (given.has(id)) element(id).value = given.get(id);
let seed = Number(given.get("seed") ?? 1);
const tally = { runs: 0, found: 0 };
function told() {
  element("size-out").textContent = `${element("size").value}″`;
  element("noise-out").textContent = `${element("noise").value}″`;
  element("rows-out").textContent = element("rows").value;
}
function measure() {
  told();
  const settings = { effect: Number(element("effect").value), size: Number(element("size").value), noise: Number(element("noise").value), rows: Number(element("rows").value), seed };
  show(run(settings), settings);
  tally.runs += 1;
  tally.found += document.body.dataset.found === "" ? 0 : 1;
  element("tally").textContent = `${tally.found} of ${tally.runs} measurements with a finding.`;
  seed += 1;
}
element("measure").addEventListener("click", measure);
document.addEventListener("input", () => { told(); tally.runs = 0; tally.found = 0; });
measure();
