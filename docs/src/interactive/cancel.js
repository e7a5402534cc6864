// Two errors of the mount of lesson 7 as knobs: how well sixty stars fit, over both.
"use strict";
const TRUTH = { foundation: 30, azimuth_index: -12, fork: 5, elevation_index: 9, nonperpendicularity: 16, tilt_x: 11, tilt_y: -6, roll: 20 };
const PAIRS = [["foundation", "azimuth_index"], ["fork", "elevation_index"], ["tilt_x", "tilt_y"], ["fork", "nonperpendicularity"], ["roll", "tilt_x"]];
const WORDS = { foundation: "foundation", azimuth_index: "azimuth index", fork: "fork", elevation_index: "elevation index", nonperpendicularity: "perpendicularity", tilt_x: "lean about x", tilt_y: "lean about y", roll: "roll" };
const STARS = Array.from({ length: 60 }, (_, i) => ({ azimuth: ((i * 137.5) % 360) * DEG, elevation: (10 + ((i * 31) % 70)) * DEG }));

const errorsOf = (arcsec) => Object.fromEntries(Object.entries(arcsec).map(([name, value]) => [name, value * ARCSEC]));
const pointing = (arcsec) => {
  const prepared = knobs.prepareExactError(errorsOf(arcsec));
  return STARS.flatMap((star) => knobs.exactError(prepared, star).pointing);
};
const MEASURED = pointing(TRUTH);
/** Root of the mean square of how far stars are from where they were measured. */
const misfit = (arcsec) => Math.sqrt(3) * rms(minus(pointing(arcsec), MEASURED));

element("pair").innerHTML = PAIRS.map(([a, b], at) => `<option value="${at}">${WORDS[a]}, ${WORDS[b]}</option>`).join("");
let shownPair = null;
function knobsOf(pair) {
  if (pair === shownPair) return;
  shownPair = pair;
  sliders("knobs", PAIRS[pair].map((name) => [name, WORDS[name], -60, 60, 1, Number(given.get(name)) || 0, "″"]));
  for (const name of PAIRS[pair]) element(`${name}-out`).textContent = `${element(name).value}″`;
}
knobsOf(Number(given.get("pair")) in PAIRS ? Number(given.get("pair")) : 0);

function draw() {
  knobsOf(valueOf("pair"));
  const [a, b] = PAIRS[shownPair];
  const set = { ...TRUTH, [a]: valueOf(a), [b]: valueOf(b) };
  const now = misfit(set);
  element("misfit").innerHTML = `<tr><td>root of the mean square</td>${told(now, inSeconds(now, 2))}</tr>`;
  element("words").textContent = now < 0.05 * ARCSEC ? "All stars fit." : "The stars do not fit.";
  const steps = Array.from({ length: 31 }, (_, i) => -60 + 4 * i);
  const cells = steps.map((y) => steps.map((x) => misfit({ ...TRUTH, [a]: x, [b]: y })));
  const most = Math.max(...cells.flat());
  chart("map", { x: [-62, 62], y: [-62, 62], xTicks: [-60, -30, 0, 30, 60], yTicks: [-60, -30, 0, 30, 60], xWords: (v) => `${v}″`, yWords: (v) => `${v}″`, title: `${WORDS[b]} (up), ${WORDS[a]} (across)` }, (place) => {
    const tiles = cells.flatMap((row, j) => row.map((cell, i) => {
      const [[x, y], [right, low]] = [place([steps[i] - 2, steps[j] + 2]), place([steps[i] + 2, steps[j] - 2])];
      const share = most > 0 ? Math.sqrt(cell / most) : 0;
      return `<rect x="${x.toFixed(1)}" y="${y.toFixed(1)}" width="${(right - x + 0.4).toFixed(1)}" height="${(low - y + 0.4).toFixed(1)}" fill="hsl(${60 + 200 * share} 70% ${70 - 58 * share}%)"/>`;
    }));
    const [x, y] = place([valueOf(a), valueOf(b)]);
    const cross = `M${x - 9} ${y}h18M${x} ${y - 9}v18`;
    return `${tiles.join("")}<path d="${cross}" stroke="#000" stroke-width="5"/><path d="${cross}" stroke="#fff" stroke-width="2.5"/>`;
  });
}
predict(draw);
