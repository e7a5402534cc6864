// Two turns in both orders: how far apart the ends are, and how the gap shrinks with the turns.
"use strict";
const at = (turn_x, turn_y) => orders.exactValue(orders.prepareExactValue({ turn_x, turn_y }));
const gapOf = (turn_x, turn_y) => {
  const { x_then_y, y_then_x } = at(turn_x, turn_y);
  return 2 * Math.asin(Math.min(1, size(minus(x_then_y, y_then_x)) / 2));
};
const WAYS = [["x_then_y", "x first", "var(--before)"], ["y_then_x", "y first", "var(--after)"]];

/** An angle in a unit that suits its size. */
function angle(radians) {
  if (radians >= DEG) return `${(radians / DEG).toFixed(2)}°`;
  const seconds = radians / ARCSEC;
  return seconds >= 0.1 ? `${seconds.toFixed(1)}″` : `${seconds.toExponential(1)}″`;
}

function drawEnds(x, y) {
  const { flat } = globe(-60);
  const circle = Array.from({ length: 73 }, (_, i) => [Math.cos(i * 5 * DEG), Math.sin(i * 5 * DEG), 0]);
  const steps = Array.from({ length: 25 }, (_, i) => i / 24);
  const ways = {
    x_then_y: [...steps.map((t) => at(x * t, 0)), ...steps.map((t) => at(x, y * t))],
    y_then_x: [...steps.map((t) => at(0, y * t)), ...steps.map((t) => at(x * t, y))],
  };
  const axes = [["x", [1.1, 0, 0]], ["y", [0, 1.1, 0]], ["z", [0, 0, 1.1]]].map(([name, tip]) => {
    const [u, v] = flat(tip);
    return `<path d="${path([[0, 0], [u, v]])}" stroke="var(--soft)"/><text x="${u}" y="${v - 3}" font-size="12" fill="var(--soft)" text-anchor="middle">${name}</text>`;
  });
  const drawn = WAYS.map(([way, words, colour], i) => {
    const points = ways[way].map((values) => flat(values[way]));
    const [u, v] = points[points.length - 1];
    return `<path d="${path(points)}" fill="none" stroke="${colour}" stroke-width="3"${i ? "" : ' stroke-dasharray="6 3"'}/><path d="${path([[0, 0], [u, v]])}" stroke="${colour}" stroke-width="2"/>` +
      `<circle cx="${u}" cy="${v}" r="5" fill="${colour}"/><text x="-135" y="${-122 + 15 * i}" font-size="12" fill="${colour}">${i ? "—" : "- -"} ${words}</text>`;
  });
  element("picture").innerHTML = `<circle r="120" fill="none" stroke="var(--line)"/><path d="${path(circle.map(flat))}" fill="none" stroke="var(--line)"/>${axes.join("")}${drawn.reverse().join("")}`;
}

function drawGap() {
  const turns = Array.from({ length: 61 }, (_, i) => 10 ** (-4 + i / 10));
  const log = (v) => Math.log10(v);
  const curve = turns.filter((deg) => deg <= 90).map((deg) => [log(deg), log(gapOf(deg * DEG, deg * DEG) / DEG)]);
  const words = (tick) => (tick >= 0 ? `${10 ** tick}°` : `10${{ 2: "⁻²", 4: "⁻⁴", 6: "⁻⁶", 8: "⁻⁸", 10: "⁻¹⁰" }[-tick]}°`);
  chart("gap", { x: [-4, 2], y: [-10, 2], xTicks: [-4, -2, 0, 2], yTicks: [-10, -8, -6, -4, -2, 0], xWords: words, yWords: words, title: "gap (up), both turns (across)" },
    (place) => line(place, [[-4, -4.58], [2, 1.42]], "var(--soft)", "5 4") + line(place, curve, "var(--effect)"));
  element("gaps").innerHTML = [[30, "30°"], [3, "3°"], [0.3, "0.3°"], [10 / 3600, "10″"]].map(([deg, turn]) => {
    const gap = gapOf(deg * DEG, deg * DEG);
    return `<tr><td>${turn}</td>${told(gap, angle(gap))}</tr>`;
  }).join("");
}

sliders("knobs", [["turn_x", "about x", 0, 90, 1, 30, "°"], ["turn_y", "about y", 0, 90, 1, 30, "°"]]);
predict(() => {
  const [x, y] = [valueOf("turn_x") * DEG, valueOf("turn_y") * DEG];
  const ends = at(x, y);
  element("ends").innerHTML = WAYS.map(([way, words]) => `<tr><td>${words}</td>${ends[way].map((v) => told(v, v.toFixed(4))).join("")}</tr>`).join("");
  element("words").textContent = `The ends are ${angle(gapOf(x, y))} apart. The product of the turns is ${angle(x * y)}.`;
  drawEnds(x, y);
  drawGap();
});
