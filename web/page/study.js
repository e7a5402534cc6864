// The lines of a study that say which column is what, as `init` writes them: `azimuth = { column = "encoder_az", unit = "deg" }`.

const LINE = /^(\s*)([A-Za-z_]\w*)(\s*=\s*)\{\s*column\s*=\s*("(?:[^"\\]|\\.)*"|'[^']*')(?:\s*,\s*unit\s*=\s*("(?:[^"\\]|\\.)*"|'[^']*'))?\s*\}\s*$/;
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
    const found = ["columns", "observed"].includes(table) ? line.match(LINE) : null;
    return found ? [{ number, table, key: found[2], column: plain(found[4]), unit: plain(found[5]) }] : [];
  });
}

/** The study with another column or unit in one of these lines. */
export function withColumn(study, { number }, column, unit) {
  const lines = study.split("\n"), found = lines[number]?.match(LINE);
  if (!found) return study;
  const of = unit ? `, unit = ${JSON.stringify(unit)}` : "";
  lines[number] = `${found[1]}${found[2]}${found[3]}{ column = ${JSON.stringify(column)}${of} }`;
  return lines.join("\n");
}
