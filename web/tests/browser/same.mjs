// Whether two reports say the same: every word, and every number as far as another processor's arithmetic leaves it.

/** Numbers that differ by no more than this part of the larger are the same. */
const RELATIVE = 1e-8;
/** What an explanation gains that was not accepted is where a search for a maximum ends: its own tolerance, not the arithmetic's. */
const OF_SEARCH = { path: /^contest\.\d+\.gain$/, relative: 1e-6 };
/** Radians and metres below this are rounding of what is nought. */
const ABSOLUTE = 1e-15;

/** Where two reports differ, as texts; what says when and how they were made is left out. */
export function differences(one, other) {
  const found = [];
  const walk = (x, y, path) => {
    if (path === "provenance") return;
    if (typeof x === "number" && typeof y === "number") {
      const apart = Math.abs(x - y);
      const relative = OF_SEARCH.path.test(path) ? OF_SEARCH.relative : RELATIVE;
      if (apart > ABSOLUTE && apart > relative * Math.max(Math.abs(x), Math.abs(y))) found.push(`${path}: ${x} and ${y}`);
    } else if (x !== null && y !== null && typeof x === "object" && typeof y === "object") {
      for (const key of new Set([...Object.keys(x), ...Object.keys(y)])) walk(x[key], y[key], path ? `${path}.${key}` : key);
    } else if (x !== y) found.push(`${path}: ${JSON.stringify(x)} and ${JSON.stringify(y)}`);
  };
  walk(one, other, "");
  return found;
}
