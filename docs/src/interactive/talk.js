// An effect of the mount that nobody declared, and what is left after the two indices are fitted.
"use strict";
const EFFECTS = {
  tilt_x: "the mount leans", nonperpendicularity: "axes are not perpendicular", collimation: "the tube is askew", eccentricity: "azimuth disc off centre",
  ellipticity: "azimuth disc oval", whirl: "azimuth bearing with three lobes", gravity: "the tube sags", refraction: "refraction not removed",
};
const NAMES = Object.keys(EFFECTS);
const NOISE = 2;
let seed = Number(given.get("seed") ?? 1);
let hidden = null;
const tally = { right: 0, of: 0 };

/** Stars, and where on the sky up and sideways are there. */
function stars() {
  const random = generator(seed);
  return Array.from({ length: 200 }, () => {
    const [azimuth, elevation] = [2 * Math.PI * random.uniform(), (12 + 70 * random.uniform()) * DEG];
    const [sa, ca, se, ce] = [Math.sin(azimuth), Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation)];
    return { joints: { azimuth, elevation }, up: [-sa * se, -ca * se, ce], side: [-ca, sa, 0], noise: [random.normal(), random.normal()] };
  });
}

/** What is left upwards and sideways, after the indices are fitted. */
function left(name, arcsec) {
  const errors = effects.prepareExactError({ ...effects.noErrors, [name]: arcsec * ARCSEC });
  const none = effects.prepareFirstOrderJacobian(effects.noErrors);
  const seen = stars();
  const measured = seen.flatMap(({ joints, up, side, noise }) => {
    const error = effects.exactError(errors, joints).pointing;
    return [dot(up, error) + NOISE * ARCSEC * noise[0], dot(side, error) + NOISE * ARCSEC * noise[1]];
  });
  const columns = ["azimuth_index", "elevation_index"].map((index) => {
    const at = Object.keys(effects.noErrors).indexOf(index);
    return seen.flatMap(({ joints, up, side }) => {
      const column = effects.firstOrderJacobian(none, joints).pointing.map((row) => row[at]);
      return [dot(up, column), dot(side, column)];
    });
  });
  const [a, b] = fitted(columns, measured);
  const rest = measured.map((value, i) => (value - a * columns[0][i] - b * columns[1][i]) / ARCSEC);
  return seen.map(({ joints }, i) => ({ ...joints, up: rest[2 * i], side: rest[2 * i + 1] }));
}

/** Size of a wave over the azimuth. */
function wave(rows, which, times) {
  const [c, s] = [Math.cos, Math.sin].map((f) => rows.map((row) => f(times * row.azimuth)));
  const ones = rows.map(() => 1);
  const [, a, b] = fitted([ones, c, s], rows.map((row) => row[which]));
  return Math.hypot(a, b);
}

function draw() {
  const rows = left(hidden ?? element("effect").value, valueOf("amplitude"));
  const most = Math.max(10, ...rows.flatMap((row) => [Math.abs(row.up), Math.abs(row.side)]));
  const level = Math.ceil(most / 10) * 10;
  for (const [which, words] of [["up", "up"], ["side", "sideways"]]) {
    for (const [joint, end, ticks] of [["azimuth", 360, [0, 180, 360]], ["elevation", 90, [0, 45, 90]]]) {
      chart(`${which}-${joint}`, { x: [0, end], y: [-level, level], xTicks: ticks, yTicks: [-level, 0, level], xWords: (v) => `${v}°`, title: `${words}, over ${joint}` },
        (place) => dots(place, rows.map((row) => [row[joint] / DEG, row[which]]), which === "up" ? "var(--before)" : "var(--after)", 3));
    }
  }
  element("waves").innerHTML = [["up", "up, over the azimuth"], ["side", "sideways, over the azimuth"]].map(([which, words]) =>
    `<tr><td>${words}</td>${[1, 2].map((times) => { const value = wave(rows, which, times); return told(value, `${value.toFixed(1)}″`); }).join("")}</tr>`).join("");
}

/** Hides an effect, which the address may name for a class. */
function hide(name) {
  hidden = name;
  element("effect").disabled = true;
  element("guessing").hidden = false;
  element("verdict").textContent = "An effect is hidden. Which one?";
  draw();
}

function check() {
  if (hidden === null) return;
  const [guess, truth] = [element("guess").value, hidden];
  const isRight = guess === truth;
  tally.of += 1;
  tally.right += isRight ? 1 : 0;
  element("verdict").textContent = isRight ? `Right: ${EFFECTS[truth]}.` : `It was another: ${EFFECTS[truth]}. Compare it with your guess.`;
  element("tally").textContent = `${tally.right} of ${tally.of} guesses right.`;
  hidden = null;
  element("effect").disabled = false;
  element("effect").value = truth;
  element("guessing").hidden = true;
  draw();
}

const options = NAMES.map((name) => `<option value="${name}">${EFFECTS[name]}</option>`).join("");
element("effect").innerHTML = options;
element("guess").innerHTML = options;
element("effect").value = "eccentricity";
sliders("knobs", [["amplitude", "amplitude", 0, 40, 1, 20, "″"]]);
element("hide").addEventListener("click", () => { seed += 1; hide(NAMES[Math.floor(Math.random() * NAMES.length)]); element("guess").focus(); });
element("check").addEventListener("click", () => { check(); element("hide").focus(); });
predict(draw);
if (NAMES.includes(given.get("hidden"))) hide(given.get("hidden"));
