// Whether two reports say the same: every word, and every number as far as another processor's arithmetic leaves it.

/** Numbers that differ by no more than this part of the larger are the same. */
const RELATIVE = 1e-8;
/** Radians and metres below this are rounding of what is nought. */
const ABSOLUTE = 1e-15;
/** What the last bits decide, and how far apart it may be. */
const OTHERS = [
  // Explanations that were not accepted: their gain is where a search for a maximum ends.
  { path: /^contest\.\d+\.(gain|shows|needs)$/, relative: 1e-6, absolute: 0 },
  // What is not shown is not determined: how much of it other errors absorb depends on directions that the data hardly see.
  { path: /^not_shown\.\d+\.absorbed$/, relative: 0, absolute: Infinity },
  // The structure that remains is looked for between nearest rows. On a grid several are equally near.
  { path: /^remaining\.(looked\.\d+\.)?p_value$/, relative: 0, absolute: 0.05 },
];

// Explanations with equal gains stand in any order.
const inOrder = (report) => ({ ...report, contest: [...(report.contest ?? [])].sort((a, b) => (a.name < b.name ? -1 : 1)) });

/** Where two reports differ, as texts; what says when and how they were made is left out. */
export function differences(one, other) {
  const found = [];
  const walk = (x, y, path) => {
    if (path === "provenance") return;
    if (typeof x === "number" && typeof y === "number") {
      const { relative, absolute } = OTHERS.find((own) => own.path.test(path)) ?? { relative: RELATIVE, absolute: ABSOLUTE };
      if (Math.abs(x - y) > Math.max(absolute, relative * Math.max(Math.abs(x), Math.abs(y)))) found.push(`${path}: ${x} and ${y}`);
    } else if (x !== null && y !== null && typeof x === "object" && typeof y === "object") {
      for (const key of new Set([...Object.keys(x), ...Object.keys(y)])) walk(x[key], y[key], path ? `${path}.${key}` : key);
    } else if (x !== y) found.push(`${path}: ${JSON.stringify(x)} and ${JSON.stringify(y)}`);
  };
  walk(inOrder(one), inOrder(other), "");
  return found;
}
