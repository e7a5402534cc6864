// The page: which part is shown, and what both parts share.
import { prepare } from "./engine.js";
import { openTable } from "./table.js";
import { openFormulas } from "./formulas.js";

const at = (id) => document.getElementById(id);
let formulas = null;

// The part behind the `#`: `formulas`, with what was written there, or the table.
const show = () => {
  const is = location.hash.startsWith("#formulas");
  at("table").hidden = is;
  at("formulas").hidden = !is;
  at("to-table").toggleAttribute("aria-current", !is);
  at("to-formulas").toggleAttribute("aria-current", is);
  document.title = is ? "trueaxis: formulas of an instrument" : "trueaxis: find what your instrument does wrong";
  if (is) (formulas ??= openFormulas()).restore(location.hash.slice("#formulas".length).replace(/^=/, ""));
};

openTable();
addEventListener("hashchange", show);
show();
prepare().catch(() => { /* Whoever asks for work is told. */ });
