// The lines of a study that say which column is what: `azimuth = { column = "encoder_az", unit = "deg" }`, or `x = "east"`.

const LINE = /^(\s*)([A-Za-z_]\w*)(\s*=\s*)\{\s*column\s*=\s*("(?:[^"\\]|\\.)*"|'[^']*')(?:\s*,\s*unit\s*=\s*("(?:[^"\\]|\\.)*"|'[^']*'))?\s*\}\s*$/;
const BARE = /^(\s*)([A-Za-z_]\w*)(\s*=\s*)("(?:[^"\\]|\\.)*"|'[^']*')\s*$/;
// What in these tables is a text and no column.
const OTHER = ["kind", "object", "station", "from", "to"];
const plain = (quoted) => {
  if (quoted === undefined) return undefined;
  if (quoted.startsWith("'")) return quoted.slice(1, -1);
  try { return JSON.parse(quoted); } catch { return quoted.slice(1, -1); }
};

/** What each such line says: the table of the study that it stands in, its key, the column and the unit. */
export function columnsOf(study) {
  let table = "";
  return study.split("\n").flatMap((line, number) => {
    const heading = line.match(/^\s*\[([^\]]*)\]/);
    if (heading) table = heading[1].trim();
    const found = ["columns", "observed"].includes(table) ? line.match(LINE) ?? line.match(BARE) : null;
    return found && !OTHER.includes(found[2]) ? [{ number, table, key: found[2], column: plain(found[4]), unit: plain(found[5]) }] : [];
  });
}

/** The study with another column or unit in one of these lines. */
export function withColumn(study, { number }, column, unit) {
  const lines = study.split("\n"), found = lines[number]?.match(LINE) ?? lines[number]?.match(BARE);
  if (!found) return study;
  const of = unit ? `, unit = ${JSON.stringify(unit)}` : "";
  lines[number] = `${found[1]}${found[2]}${found[3]}{ column = ${JSON.stringify(column)}${of} }`;
  return lines.join("\n");
}
