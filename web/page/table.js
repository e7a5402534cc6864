// A table from the moment it is dropped to its corrected copy.
import { Engine, Stopped } from "./engine.js";
import { text } from "./message.js";
import { columnsOf, withColumn } from "./study.js";
import { offer, shownIn } from "./files.js";

/** Tables beyond this are for the command: a browser holds the whole table and everything that is computed of it. */
const LARGEST = 64 << 20;

export function openTable() {
  const at = (id) => document.getElementById(id), engine = new Engine();
  // What was dropped: tables by their names, and a robot's description.
  let tables = new Map(), robot = null, instrument = null, names = {};

  const trouble = (error) => {
    at("trouble").hidden = error === null;
    at("trouble").textContent = error === null ? "" : error.message;
    if (error !== null) at("trouble").scrollIntoView({ block: "nearest" });
  };
  const tell = (told) => { at("progress").textContent = told; };
  const listed = (answer, name) => JSON.parse(text(answer, name) || "[]");
  const paragraphs = (into, lines, of = "li") => into.replaceChildren(...lines.map((line) => Object.assign(document.createElement(of), { textContent: line })));
  // Runs work that a person may stop; buttons that would disturb it are off meanwhile.
  const busy = async (work, failed = trouble) => {
    const others = ["calibrate", "example", "paste", "generate"].map(at);
    others.forEach((button) => { button.disabled = true; });
    at("cancel").hidden = false;
    trouble(null);
    try { return await work(); } catch (error) {
      if (error instanceof Stopped) tell("Stopped."); else { tell(""); failed(error); }
      return null;
    } finally {
      others.forEach((button) => { button.disabled = false; });
      at("cancel").hidden = true;
    }
  };

  // The kinds of instrument, to choose from.
  let known = null;
  const kinds = () => (known ??= engine.ask([["do", "templates"]]).then((answer) => {
    const options = listed(answer, "templates").map((one) => new Option(`${one.name}: ${one.what}`, one.name));
    at("kind").replaceChildren(new Option("Choose the instrument", ""), ...options, new Option("robot: as its URDF describes it", "robot"));
  }).catch((error) => { known = null; throw error; }));

  const drop = async (files) => {
    const own = [...files];
    if (!own.length) return;
    const large = own.find((file) => file.size > LARGEST);
    if (large) {
      trouble(new Error(`${large.name} has ${Math.round(large.size / (1 << 20))} MiB, and a browser page takes at most ${LARGEST >> 20}. Use the command for it: trueaxis init ${large.name}`));
      return;
    }
    const ends = (file, ...endings) => endings.some((ending) => file.name.toLowerCase().endsWith(ending));
    const chain = own.find((file) => ends(file, ".chain")), study = own.find((file) => ends(file, ".toml")), urdf = own.find((file) => ends(file, ".urdf"));
    const data = own.filter((file) => ![chain, study, urdf].includes(file));
    if (data.length) tables = new Map(await Promise.all(data.map(async (file) => [file.name, new Uint8Array(await file.arrayBuffer())])));
    if (urdf || data.length) robot = urdf ? await urdf.text() : null;
    at("result").hidden = true;
    if (study && chain) {
      await studied(await chain.text(), await study.text(), study.name);
    } else if (study || chain) {
      trouble(new Error(study ? `${study.name} names a declaration. Drop the .chain file and the table together with it.` : `${chain.name} is a declaration. Drop the study (.toml) and the table together with it, or open "Formulas".`));
    } else if (!tables.size) {
      trouble(new Error("No table was dropped. Drop the table of measurements together with the robot's description."));
    } else await begin();
  };

  // A declaration and a study that somebody has already, with the first rows of the table.
  const studied = async (chain, study, name) => {
    const [table] = tables;
    const answer = table && await busy(async () => { await kinds(); return engine.ask([["do", "look"], ["name", table[0]], ["table", table[1]]]); });
    if (table && !answer) return;
    shown({ what: `Your own declaration and study: ${name}.`, chain, study, study_name: name, kind: "", remarks: [], columns: answer ? listed(answer, "columns") : [] });
  };

  // Asks what the table is of.
  const begin = async (template) => {
    const [name, bytes] = [...tables][0], asked = [["do", "begin"], ["name", name], ["table", bytes]];
    if (template) asked.push(["template", template]);
    if (robot) asked.push(["urdf", robot]);
    tell("");
    const answer = await busy(async () => { await kinds(); return engine.ask(asked, tell); });
    tell("");
    if (!answer) {
      // The person can still say which instrument it is.
      at("read").hidden = false;
      at("what").textContent = `${name} was not recognised. Choose the instrument, or write a declaration and a study.`;
      names = { study: "study.toml" };
      at("kind").value = template ?? "";
      return;
    }
    shown({ what: `${sentence(text(answer, "what"))}.`, kind: text(answer, "template"), chain: text(answer, "chain"), study: text(answer, "study"),
      study_name: text(answer, "study-name"), remarks: [...listed(answer, "remarks"), ...listed(answer, "warnings")], columns: listed(answer, "columns") });
  };
  const sentence = (words) => words.charAt(0).toUpperCase() + words.slice(1);

  const shown = (own) => {
    trouble(null);
    names = { study: own.study_name };
    at("what").textContent = own.what;
    at("chain").value = own.chain;
    at("study").value = own.study;
    at("kind").value = own.kind;
    paragraphs(at("remarks"), own.remarks);
    const row = (cells, of) => { const line = document.createElement("tr"); paragraphs(line, cells, of); return line; };
    const head = document.createElement("thead"), body = document.createElement("tbody");
    head.append(row(own.columns.map((column) => column.name), "th"));
    const rows = Math.max(0, ...own.columns.map((column) => column.cells.length));
    for (let i = 0; i < rows; i++) body.append(row(own.columns.map((column) => column.cells[i] ?? ""), "td"));
    at("rows").replaceChildren(...(own.columns.length ? [head, body] : []));
    columns(own.columns.map((column) => column.name));
    at("read").hidden = false;
    at("read-title").focus();
  };

  // The study's columns as choices; a change is written into the study, which is what counts.
  const columns = (header) => {
    const lines = columnsOf(at("study").value);
    at("columns-part").hidden = !lines.length || !header.length;
    const head = document.createElement("thead"), body = document.createElement("tbody");
    head.innerHTML = "<tr><th scope=col>what it is</th><th scope=col>column</th><th scope=col>unit</th></tr>";
    for (const line of lines) {
      const row = document.createElement("tr"), what = document.createElement("th"), select = document.createElement("select"), unit = document.createElement("input");
      const is = line.table === "observed" ? `observed ${line.key}` : line.key;
      what.scope = "row";
      what.textContent = is;
      select.append(...[...new Set([...header, line.column])].map((name) => new Option(name, name, false, name === line.column)));
      select.setAttribute("aria-label", `Column of ${is}`);
      unit.value = line.unit ?? "";
      unit.setAttribute("list", "units");
      unit.setAttribute("aria-label", `Unit of ${is}`);
      unit.placeholder = "none";
      const changed = () => { at("study").value = withColumn(at("study").value, line, select.value, unit.value.trim()); };
      select.addEventListener("change", changed);
      unit.addEventListener("change", changed);
      row.append(what, ...[select, unit].map((own) => { const cell = document.createElement("td"); cell.append(own); return cell; }));
      body.append(row);
    }
    at("columns").replaceChildren(head, body);
  };

  const calibrate = async () => {
    const date = new Date().toISOString().slice(0, 10);
    const asked = [["do", "calibrate"], ["study-name", names.study], ["study", at("study").value], ["chain", at("chain").value], ["date", date]];
    for (const [name, bytes] of tables) asked.push([`table:${name}`, bytes]);
    at("result").hidden = true;
    const began = performance.now();
    const answer = await busy(() => engine.ask(asked, tell));
    if (!answer) return;
    const took = (performance.now() - began) / 1000;
    tell(`Done in ${took.toFixed(1)} s.`);
    at("progress").dataset.seconds = took.toFixed(2);
    at("progress").dataset.memory = engine.memory;
    at("badge").textContent = `${text(answer, "badge")}.`;
    at("happened").textContent = text(answer, "happened");
    paragraphs(at("warnings"), listed(answer, "warnings"), "p");
    for (const line of at("warnings").children) line.className = "caution";
    const made = [...answer].filter(([name]) => name.startsWith("file:")).map(([name, bytes]) => [name.slice(5), bytes]);
    offer(at("files"), made);
    at("own").href = shownIn(at("report"), answer.get("file:report.html"));
    instrument = answer.get("file:instrument.toml") ?? null;
    at("code").replaceChildren();
    at("corrections").replaceChildren();
    at("corrected").textContent = "";
    for (const id of ["generate", "other"]) at(id).disabled = instrument === null;
    at("result").hidden = false;
    at("result-title").focus();
    if (instrument) for (const [name, bytes] of tables) await correct(name, bytes);
  };

  const correct = async (name, bytes) => {
    at("corrected").textContent = `correcting ${name}`;
    const answer = await busy(() => engine.ask([["do", "correct"], ["instrument", instrument], ["name", name], ["table", bytes], ["uncertainty", "yes"]]), (error) => { at("corrected").textContent = `${name} was not corrected. ${error.message}`; });
    if (!answer) return;
    at("corrected").textContent = listed(answer, "warnings").join(" ");
    offer(at("corrections"), [[`corrected-${name.replace(/\.[^.]*$/, "")}.csv`, answer.get("table")]], true);
  };

  const generate = async () => {
    const answer = await busy(() => engine.ask([["do", "generate"], ["instrument", instrument], ["language", at("language").value]]));
    if (answer) offer(at("code"), listed(answer, "files").map((name) => [name, answer.get(`file:${name}`)]));
  };

  const example = async () => {
    const found = await Promise.all(["secret.csv", "mount.chain", "study.toml"].map((name) => fetch(`examples/${name}`)));
    if (found.some((own) => !own.ok)) { trouble(new Error("The example could not be loaded. Reload the page.")); return; }
    const [table, chain, study] = found;
    tables = new Map([["secret.csv", new Uint8Array(await table.arrayBuffer())]]);
    robot = null;
    at("result").hidden = true;
    await studied(await chain.text(), await study.text(), "study.toml");
    at("what").textContent = "An alt-azimuth mount that looked at 160 stars. Its tube droops, and its declaration does not contain that.";
  };

  at("file").addEventListener("change", async ({ target }) => { await drop(target.files); target.value = ""; });
  at("other").addEventListener("change", async ({ target }) => {
    for (const file of target.files) await correct(file.name, new Uint8Array(await file.arrayBuffer()));
    target.value = "";
  });
  at("example").addEventListener("click", example);
  at("paste").addEventListener("click", () => drop([new File([at("pasted").value], "pasted.csv")]));
  at("calibrate").addEventListener("click", calibrate);
  at("cancel").addEventListener("click", () => engine.stop());
  at("generate").addEventListener("click", generate);
  at("kind").addEventListener("change", ({ target }) => { if (target.value && target.value !== "robot" && tables.size) begin(target.value); });
  at("study").addEventListener("change", () => columns([...at("rows").querySelectorAll("th")].map((cell) => cell.textContent)));
  for (const unit of ["deg", "arcmin", "arcsec", "rad", "mrad", "gon", "m", "mm", "um"]) at("units").append(new Option(unit));
  // A table may be dropped anywhere on the page.
  addEventListener("dragover", (event) => { event.preventDefault(); at("drop").classList.add("over"); });
  addEventListener("dragleave", (event) => { if (!event.relatedTarget) at("drop").classList.remove("over"); });
  addEventListener("drop", (event) => { event.preventDefault(); at("drop").classList.remove("over"); drop(event.dataTransfer.files); });
  kinds().catch((error) => { if (!(error instanceof Stopped)) trouble(error); });
  // For tests: whether the worker can reach an address.
  window.reaches = (address) => engine.reaches(address);
}
