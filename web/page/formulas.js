// The formulas of a declaration while somebody types it; the link carries what was typed.
import { Engine, Stopped } from "./engine.js";
import { text } from "./message.js";

/** A person types on for so long before the page computes, ms. */
const PAUSE = 400;
/** What the link carries, by the ids of the fields. */
const FIELDS = ["declared", "order", "form", "sizes", "ranges", "spoken", "formula"];

export function openFormulas() {
  const at = (id) => document.getElementById(id), engine = new Engine(), answer = at("answer");
  const asked = () => document.querySelector("input[name=ask]:checked").value;
  let timer = 0, last = null;

  const parts = (what) => {
    const chain = ["chain", at("declared").value];
    const more = { derive: [["order", at("order").value]], identify: [], bound: [["sizes", at("sizes").value], ["ranges", at("ranges").value]],
      code: [["language", at("spoken").value]], check: [["formula", at("formula").value]] };
    return [["do", what], chain, ...more[what]];
  };
  const compute = async () => {
    const what = asked();
    for (const own of ["derive", "bound", "code", "check"]) at(`of-${own}`).hidden = own !== what;
    if (!at("declared").value.trim()) { answer.textContent = "Write a declaration, or choose an instrument from the gallery."; return; }
    at("thinking").textContent = "computing";
    try {
      const made = await engine.ask(parts(what), (told) => { at("thinking").textContent = told; });
      const warnings = JSON.parse(text(made, "warnings")), files = JSON.parse(text(made, "files") || "[]");
      const body = what === "code" ? files.map((name) => (files.length > 1 ? `${name}\n\n` : "") + text(made, `file:${name}`)).join("\n\n")
        : text(made, what === "derive" && at("form").value === "latex" ? "latex" : "text");
      answer.textContent = [...warnings.map((warning) => `warning: ${warning}`), body].join("\n");
      answer.classList.remove("wrong");
      answer.classList.toggle("code", what === "code");
      at("thinking").textContent = what === "check" ? (text(made, "status") === "done" ? "The formula holds." : "The formula does not hold, or was not read.") : "";
    } catch (error) {
      if (error instanceof Stopped) return;
      answer.textContent = error.message;
      answer.classList.add("wrong");
      answer.classList.remove("code");
      at("thinking").textContent = "";
    }
  };
  const soon = () => { clearTimeout(timer); timer = setTimeout(async () => { await remember(); compute(); }, PAUSE); };

  // Packed as the link has it: letters, digits, - and _.
  const squeezed = async (bytes, stream) => new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
  const packed = async (state) => {
    const bytes = await squeezed(new TextEncoder().encode(JSON.stringify(state)), new CompressionStream("deflate-raw"));
    return btoa(String.fromCharCode(...bytes)).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
  };
  const unpacked = async (word) => {
    const bytes = Uint8Array.from(atob(word.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
    return JSON.parse(new TextDecoder().decode(await squeezed(bytes, new DecompressionStream("deflate-raw"))));
  };
  const remember = async () => {
    last = await packed({ ask: asked(), ...Object.fromEntries(FIELDS.map((id) => [id, at(id).value])) });
    if (location.hash.startsWith("#formulas")) history.replaceState(null, "", `#formulas=${last}`);
  };
  const restore = async (word) => {
    if (word && word === last) return;
    if (word) {
      try {
        const state = await unpacked(word);
        last = word;
        for (const id of FIELDS) if (typeof state[id] === "string") at(id).value = state[id];
        const ask = document.querySelector(`input[name=ask][value="${CSS.escape(String(state.ask))}"]`);
        if (ask) ask.checked = true;
      } catch {
        answer.textContent = "The link is damaged: it does not hold a declaration. Ask for it again.";
        answer.classList.add("wrong");
        return;
      }
    } else if (!at("declared").value) await choose("alt-azimuth");
    compute();
  };
  const choose = async (name) => {
    const found = name && await fetch(`gallery/${encodeURIComponent(name)}.chain`);
    if (found?.ok) { at("declared").value = await found.text(); at("gallery").value = name; }
  };

  fetch("gallery/index.txt").then(async (found) => {
    if (found.ok) at("gallery").append(...(await found.text()).split("\n").filter(Boolean).map((name) => new Option(name, name)));
  }, () => {});
  at("gallery").addEventListener("change", async ({ target }) => { await choose(target.value); soon(); });
  for (const id of FIELDS) at(id).addEventListener("input", soon);
  document.querySelectorAll("input[name=ask]").forEach((input) => input.addEventListener("change", soon));
  at("share").addEventListener("click", async () => {
    await remember();
    const done = await navigator.clipboard?.writeText(location.href).then(() => true, () => false);
    at("shared").textContent = done ? "Copied." : "The address bar has the link.";
  });
  return { restore };
}
