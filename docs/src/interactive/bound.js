// Random mounts beside the bound that `trueaxis bound` proves: `bounds` has it for each size.
"use strict";
const DRAWS = 2000;
let seed = Number(given.get("seed") ?? 1);

/** Differences of exact and first order, for errors drawn within a size. */
function drawn(arcsec) {
  const random = generator(seed);
  const turn = () => 2 * random.uniform() - 1;
  return Array.from({ length: DRAWS }, () => {
    const errors = Object.fromEntries(Object.keys(mount.noErrors).map((name) => [name, turn() * arcsec * ARCSEC]));
    const joints = { azimuth: Math.PI * turn(), elevation: (Math.PI / 2) * random.uniform() };
    const [exact, first] = [mount.exactError(mount.prepareExactError(errors), joints), mount.firstOrderError(mount.prepareFirstOrderError(errors), joints)];
    return size(minus(exact.pointing, first.pointing));
  });
}

const small = (radians) => {
  const seconds = radians / ARCSEC;
  return `${seconds >= 0.01 ? seconds.toPrecision(3) : seconds.toExponential(1)}″`;
};

function draw() {
  const [arcsec, bound, found] = bounds[valueOf("largest")];
  element("largest-out").textContent = arcsec < 3600 ? `${arcsec}″` : `${arcsec / 3600}°`;
  element("largest").setAttribute("aria-valuetext", element("largest-out").textContent);
  const differences = drawn(arcsec);
  const most = Math.max(...differences);
  const beyond = differences.filter((value) => value > bound).length;
  element("words").textContent = `${beyond} of ${DRAWS} draws are beyond the bound.`;
  element("numbers").innerHTML = [["proven for all", bound], ["found by the search", found], ["largest of these draws", most]].map(([words, value]) => `<tr><td>${words}</td>${told(value, small(value))}</tr>`).join("");
  const counts = Array.from({ length: 24 }, () => 0);
  for (const value of differences) counts[Math.min(23, Math.floor((20 * value) / bound))] += 1;
  const high = Math.max(...counts);
  chart("many", { x: [0, 1.2], y: [0, high * 1.1], xTicks: [0, 0.25, 0.5, 0.75, 1], yTicks: [0, Math.round(high / 2), high], xWords: (v) => `${100 * v} %` }, (place) => {
    const bars = counts.map((count, i) => { const [[x, y], [right, low]] = [place([i / 20, count]), place([(i + 1) / 20, 0])]; return `<rect x="${x + 0.5}" y="${y}" width="${right - x - 1}" height="${low - y}" fill="var(--before)"/>`; });
    return bars.join("") + line(place, [[1, 0], [1, high * 1.1]], "var(--effect)") + line(place, [[found / bound, 0], [found / bound, high * 1.1]], "var(--found)", "5 4");
  });
}

sliders("knobs", [["largest", "largest error", 0, bounds.length - 1, 1, bounds.findIndex(([arcsec]) => arcsec === 60), ""]]);
element("again").addEventListener("click", () => { seed += 1; draw(); });
predict(draw);
