// What the pages with a question share: the question, sliders, charts, a sphere, random numbers with a seed, small fits.
"use strict";
const [DEG, ARCSEC] = [Math.PI / 180, Math.PI / 648000];
const element = (id) => document.getElementById(id);
const given = new URLSearchParams(location.hash.slice(1));
const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
const minus = (a, b) => a.map((value, i) => value - b[i]);
const size = (v) => Math.hypot(...v);
const rms = (values) => Math.sqrt(dot(values, values) / Math.max(1, values.length));
const valueOf = (id) => Number(element(id).value);
const inSeconds = (radians, digits = 1) => {
  const words = (radians / ARCSEC).toFixed(digits);
  return `${Number(words) === 0 ? words.replace("-", "") : words.replace("-", "−")}″`;
};

/** A cell or a span whose exact number a program can read. */
const told = (value, words, tag = "td") => `<${tag} data-value="${value}">${words}</${tag}>`;

/** Sliders for names: `[id, words, least, most, step, start, unit]`. */
function sliders(into, rows) {
  element(into).innerHTML = rows.map(([id, words, least, most, step, start, unit]) =>
    `<label for="${id}"><span>${words}</span> <input type="range" id="${id}" min="${least}" max="${most}" step="${step}" value="${start}" data-unit="${unit}"> <output id="${id}-out"></output></label>`).join("");
}

/** Asks first; `draw` is called once an answer is chosen, and again whenever something is moved. `#choice=1` answers in the address. */
function predict(draw) {
  for (const [id, value] of given) {
    const input = element(id);
    const isKnown = input?.tagName === "SELECT" && [...input.options].some((option) => option.value === value);
    if (input?.type === "range" || isKnown) input.value = value;
  }
  const refresh = () => {
    for (const input of document.querySelectorAll("input[type=range]")) {
      const words = `${input.value}${input.dataset.unit}`;
      element(`${input.id}-out`).textContent = words;
      input.setAttribute("aria-valuetext", words);
    }
    draw();
  };
  const choices = [...element("prediction").querySelectorAll("input[name=choice]")];
  const answer = () => {
    const chosen = choices.find((choice) => choice.checked);
    if (!chosen) {
      element("answer").textContent = "Choose an answer first.";
      return;
    }
    const right = choices.find((choice) => "right" in choice.dataset);
    const isRight = chosen === right;
    element("answer").textContent = isRight ? "Right." : `Not this one. The answer: ${right.parentElement.textContent.trim()}`;
    element("answer").dataset.right = String(isRight);
    element("shown").hidden = false;
    refresh();
  };
  element("prediction").addEventListener("submit", (event) => { event.preventDefault(); answer(); });
  element("shown").addEventListener("input", refresh);
  const choice = choices[Number(given.get("choice") ?? NaN)];
  if (choice) {
    choice.checked = true;
    answer();
  }
}

/** Uniform and normal random numbers with a seed (mulberry32 and Box-Muller), so that a page shows the same again. */
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

/** Coefficients of the columns that fit best, by normal equations: for two or three columns that differ. */
function fitted(columns, values) {
  const rows = columns.map((column) => [...columns.map((other) => dot(column, other)), dot(column, values)]);
  const n = rows.length;
  for (let i = 0; i < n; i += 1) {
    for (let j = 0; j < n; j += 1) {
      if (i === j) continue;
      const share = rows[j][i] / rows[i][i];
      rows[j] = rows[j].map((value, k) => value - share * rows[i][k]);
    }
  }
  return rows.map((row, i) => row[n] / row[i]);
}

/** A line of points as a path. */
const path = (points) => points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");

/** A chart: ranges, ticks and their words in `axes`; `layers(place)` gives what stands in it. */
function chart(id, { x, y, xTicks, yTicks, xWords = String, yWords = String, title = "" }, layers) {
  const [left, top, width, height] = [46, 18, 292, 200];
  const place = ([a, b]) => [left + ((a - x[0]) / (x[1] - x[0])) * width, top + ((y[1] - b) / (y[1] - y[0])) * height];
  const across = xTicks.map((tick) => { const [at] = place([tick, y[0]]); return `<text x="${at}" y="${top + height + 16}" text-anchor="middle">${xWords(tick)}</text>`; });
  const up = yTicks.map((tick) => { const [, at] = place([x[0], tick]); return `<text x="${left - 5}" y="${at + 4}" text-anchor="end">${yWords(tick)}</text><path d="M${left} ${at}h${width}" stroke="var(--line)"/>`; });
  element(id).setAttribute("viewBox", "0 0 360 240");
  element(id).innerHTML = `<g font-size="12" fill="currentColor"><text x="${left}" y="11">${title}</text>${across.join("")}${up.join("")}</g>${layers(place)}`;
}

const dots = (place, points, colour, radius = 2.5) => `<g fill="${colour}">${points.map((p) => { const [x, y] = place(p); return `<circle cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="${radius}"/>`; }).join("")}</g>`;
const line = (place, points, colour, dash = "") => `<path d="${path(points.map(place))}" fill="none" stroke="${colour}" stroke-width="2.5"${dash ? ` stroke-dasharray="${dash}"` : ""}/>`;

/** The unit sphere seen from `azimuth` and from 25° above: where a point stands in the picture, and whether it is in front. */
function globe(azimuth, radius = 120, above = 25) {
  const [c, s, ca, sa] = [Math.cos(azimuth * DEG), Math.sin(azimuth * DEG), Math.cos(above * DEG), Math.sin(above * DEG)];
  const flat = ([x, y, z]) => [radius * (c * x - s * y), -radius * (sa * (s * x + c * y) + ca * z)];
  const isFront = ([x, y, z]) => -ca * (s * x + c * y) + sa * z >= 0;
  return { flat, isFront };
}
