// The mount of the course: its error at each direction of the sky, as arrows on half a sphere.
"use strict";
const ERRORS = Object.keys(mount.noErrors);
const PLACES = {
  "azimuth-axis": [["tilt_x", "leans about x"], ["tilt_y", "leans about y"], ["azimuth_index", "index"]],
  "elevation-axis": [["nonperpendicularity", "not perpendicular"], ["elevation_index", "index"]],
  tube: [["collimation", "collimation"]],
};
const at = (azimuth, elevation) => ({ azimuth: azimuth * DEG, elevation: elevation * DEG });

for (const [place, errors] of Object.entries(PLACES)) {
  sliders(place, errors.map(([name, words]) => [name, words, -60, 60, 1, name === "collimation" ? 30 : 0, "″"]));
}
sliders("joints", [["azimuth", "azimuth", 0, 360, 5, 40, "°"], ["elevation", "elevation", 0, 90, 5, 30, "°"]]);

function draw() {
  const errors = Object.fromEntries(ERRORS.map((name) => [name, valueOf(name) * ARCSEC]));
  const prepared = mount.prepareExactError(errors);
  const value = mount.prepareExactValue(mount.noErrors);
  const field = [];
  for (let elevation = 0; elevation <= 80; elevation += 20) {
    for (let azimuth = 0; azimuth < 360; azimuth += elevation > 50 ? 45 : 20) {
      const joints = at(azimuth, elevation);
      field.push([mount.exactValue(value, joints).pointing, mount.exactError(prepared, joints).pointing]);
    }
  }
  const sizes = field.map(([, error]) => size(error));
  const [least, most] = [Math.min(...sizes), Math.max(...sizes)];
  const { flat, isFront } = globe(valueOf("view"));
  const longer = most > 0 ? 0.24 / most : 0;
  const arrows = field.map(([from, error]) => {
    const [a, b] = [flat(from), flat(from.map((v, i) => v + longer * error[i]))];
    const look = `stroke="var(--before)" stroke-width="2" opacity="${isFront(from) ? 1 : 0.35}"`;
    return `<path d="${path([a, b])}" ${look}/><circle cx="${a[0].toFixed(1)}" cy="${a[1].toFixed(1)}" r="2" fill="var(--soft)"/>`;
  });
  const rings = [0, 20, 40, 60, 80].map((elevation) => Array.from({ length: 73 }, (_, i) => mount.exactValue(value, at(5 * i, elevation)).pointing));
  const chosen = at(valueOf("azimuth"), valueOf("elevation"));
  const [u, v] = flat(mount.exactValue(value, chosen).pointing);
  const [zx, zy] = flat([0, 0, 1]);
  element("sky").innerHTML = rings.map((ring) => `<path d="${path(ring.map(flat))}" fill="none" stroke="var(--line)"/>`).join("") +
    `<path d="${path([[0, 0], [zx, zy]])}" stroke="var(--soft)" stroke-dasharray="4 4"/><path d="${path([[0, 0], [u, v]])}" stroke="var(--after)" stroke-width="2"/>${arrows.join("")}` +
    `<circle cx="${u}" cy="${v}" r="6" fill="none" stroke="var(--after)" stroke-width="2"/>` +
    [["N", [0, 1.12, 0]], ["E", [1.12, 0, 0]], ["S", [0, -1.12, 0]], ["W", [-1.12, 0, 0]]].map(([name, tip]) => { const [x, y] = flat(tip); return `<text x="${x}" y="${y + 4}" font-size="12" text-anchor="middle" fill="currentColor">${name}</text>`; }).join("");
  element("words").textContent = most > 0 ? `The error is ${inSeconds(least)} at the least and ${inSeconds(most)} at the most, over these directions.` : "No error anywhere.";
  const first = mount.firstOrderError(mount.prepareFirstOrderError(errors), chosen).pointing;
  element("error").innerHTML = [["exact", mount.exactError(prepared, chosen).pointing], ["first order", first]]
    .map(([words, error]) => `<tr><td>${words}</td>${error.map((v) => told(v, inSeconds(v, 2))).join("")}</tr>`).join("");
}

element("zero").addEventListener("click", () => {
  for (const name of ERRORS) element(name).value = 0;
  element("shown").dispatchEvent(new Event("input"));
});
predict(draw);
