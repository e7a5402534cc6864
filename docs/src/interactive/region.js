// Three causes fitted to stars of a limited range of elevations: alike inside, apart outside.
"use strict";
const CAUSES = [["gravity", "gravity", "var(--before)", ""], ["refraction", "refraction", "var(--after)", "9 4"], ["encoder", "disc off centre", "var(--effect)", "3 3"]];
const [SAG, NOISE, ROWS] = [26, 2, 60];
const none = effects.prepareFirstOrderJacobian(effects.noErrors);

/** How far an error of one second of arc moves the line of sight upwards, in seconds of arc. */
function lift(name, elevation) {
  const at = Object.keys(effects.noErrors).indexOf(name);
  const column = effects.firstOrderJacobian(none, { azimuth: 0, elevation }).pointing.map((row) => row[at]);
  return dot([0, -Math.sin(elevation), Math.cos(elevation)], column);
}

function draw() {
  const [a, b] = [valueOf("from"), valueOf("to")];
  const [from, to] = [Math.min(a, b), Math.max(a, b, Math.min(a, b) + 5)];
  const random = generator(Number(given.get("seed") ?? 3));
  const stars = Array.from({ length: ROWS }, (_, i) => {
    const elevation = from + ((i + 0.5) / ROWS) * (to - from);
    return [elevation, SAG * lift("gravity", elevation * DEG) + NOISE * random.normal()];
  });
  const grid = Array.from({ length: 80 }, (_, i) => 6 + i);
  const fits = CAUSES.map(([name, words, colour, dash]) => {
    const columns = ["elevation_index", name].map((error) => stars.map(([elevation]) => lift(error, elevation * DEG)));
    const [index, amount] = fitted(columns, stars.map(([, value]) => value));
    const at = (elevation) => index * lift("elevation_index", elevation * DEG) + amount * lift(name, elevation * DEG);
    const rest = rms(stars.map(([elevation, value]) => value - at(elevation)));
    return { words, colour, dash, at, rest };
  });
  const apart = (degrees) => Math.max(0, ...degrees.map((elevation) => { const all = fits.map(({ at }) => at(elevation)); return Math.max(...all) - Math.min(...all); }));
  const [inside, outside] = [grid.filter((e) => e >= from && e <= to), grid.filter((e) => e < from || e > to)];
  element("causes").innerHTML = fits.map(({ words, rest, at }) => `<tr><td>${words}</td>${told(rest, `${rest.toFixed(2)}″`)}${told(at(10), `${at(10).toFixed(1)}″`)}</tr>`).join("");
  element("apart").innerHTML = [["inside", inside], ["outside, down to 6°", outside]].map(([words, where]) => `<tr><td>${words}</td>${told(apart(where), `${apart(where).toFixed(1)}″`)}</tr>`).join("");
  element("words").textContent = `Measured from ${from}° to ${to}°. Inside, the three corrections are at most ${apart(inside).toFixed(1)}″ apart. Outside, they are up to ${apart(outside).toFixed(0)}″ apart.`;
  const level = [-120, 40];
  chart("curves", { x: [0, 90], y: level, xTicks: [0, 30, 60, 90], yTicks: [-120, -80, -40, 0, 40], xWords: (v) => `${v}°`, yWords: (v) => `${v}″`, title: "upwards, over the elevation" }, (place) => {
    const [[x, y], [right, low]] = [place([from, level[1]]), place([to, level[0]])];
    const kept = ({ at }) => grid.map((e) => [e, at(e)]).filter(([, v]) => v >= level[0] && v <= level[1]);
    return `<rect x="${x}" y="${y}" width="${right - x}" height="${low - y}" fill="var(--found)" opacity="0.15"/>${dots(place, stars, "var(--soft)", 2)}` +
      fits.map((fit) => line(place, kept(fit), fit.colour, fit.dash)).join("");
  });
}

sliders("knobs", [["from", "lower end", 6, 80, 1, 40, "°"], ["to", "upper end", 15, 85, 1, 70, "°"]]);
predict(draw);
