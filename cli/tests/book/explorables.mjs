// node explorables.mjs BROWSER FOLDER PAGE…: every page with a question, as somebody with a keyboard and a narrow screen has it.
//
// The picture is hidden until an answer is chosen; then everything is reached by Tab, moved by arrow keys, and nothing is wider than
// the screen. Light and dark have enough contrast.
import assert from "node:assert/strict";
import { browse, open } from "../../../web/tests/browser/devtools.mjs";

const [program, folder, ...pages] = process.argv.slice(2);
const WIDTH = 400;
const browser = await browse(program);

/** Contrasts of all texts with what is behind them, and the smallest of them. */
const CONTRAST = `(() => {
  const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  const rgb = (colour) => { canvas.fillStyle = colour; canvas.fillRect(0, 0, 1, 1); return [...canvas.getImageData(0, 0, 1, 1).data]; };
  const light = ([r, g, b]) => { const [x, y, z] = [r, g, b].map((v) => { const s = v / 255; return s <= 0.03928 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4; }); return 0.2126 * x + 0.7152 * y + 0.0722 * z; };
  const behind = (node) => { for (let at = node; at; at = at.parentElement) { const colour = getComputedStyle(at).backgroundColor; if (!/, 0\\)$/.test(colour)) return colour; } return "Canvas"; };
  const worst = { ratio: 99 };
  for (const node of document.querySelectorAll("p, legend, label, td, th, h1, h2, h3, a, code, output, svg text")) {
    const style = getComputedStyle(node);
    if (!node.textContent.trim() || !node.getClientRects().length) continue;
    const ink = node.closest("svg") && style.fill !== "currentcolor" ? style.fill : style.color;
    const [a, b] = [light(rgb(ink)), light(rgb(behind(node)))].sort((one, other) => other - one);
    const ratio = (a + 0.05) / (b + 0.05);
    if (ratio < worst.ratio) Object.assign(worst, { ratio, words: node.textContent.trim().slice(0, 40) });
  }
  return worst;
})()`;

/** What is wider than the screen, or cut by what it stands in. */
const WIDE = `[...document.querySelectorAll("body *")].filter((node) => node.getClientRects().length && !node.closest("svg") && node.getBoundingClientRect().right > innerWidth + 0.5).map((node) => node.outerHTML.slice(0, 80))`;
/** What can be used and has no name. */
const NAMELESS = `[...document.querySelectorAll("input, select, button, svg, canvas")].filter((node) => !(node.labels?.length || node.textContent.trim() && node.tagName === "BUTTON" || node.getAttribute("aria-label"))).map((node) => node.outerHTML.slice(0, 80))`;

for (const name of pages) {
  const page = await open(browser, `file://${folder}/${name}.html`, WIDTH);
  const focused = () => page.evaluate("document.activeElement.id || document.activeElement.textContent.trim()");
  const tabTo = async (wanted) => {
    for (let i = 0; i < 60; i += 1) {
      await page.press("Tab", 9);
      if (await page.evaluate(`document.activeElement.matches(${JSON.stringify(wanted)})`)) return;
    }
    throw new Error(`${name}: Tab does not reach ${wanted}; it ends at ${await focused()}`);
  };
  assert.equal(await page.evaluate("document.getElementById('shown').hidden"), true, `${name}: shown before an answer`);
  // Without a choice, the page asks for one.
  await tabTo("button[type=submit]");
  await page.press("Enter", 13, "\r");
  assert.match(await page.evaluate("document.getElementById('answer').textContent"), /Choose an answer/);
  await page.evaluate("document.activeElement.blur()");
  await tabTo("input[name=choice]");
  await page.press(" ", 32, " ");
  await page.press("ArrowDown", 40);
  assert.equal(await page.evaluate("document.querySelector('input[name=choice]:checked').value"), "1", `${name}: arrow keys`);
  await page.press("Enter", 13, "\r");
  assert.equal(await page.evaluate("document.getElementById('shown').hidden"), false, `${name}: nothing is shown`);
  assert.match(await page.evaluate("document.getElementById('answer').textContent"), /^(Right\.|Not this one\.)/);
  await tabTo("#shown input[type=range]");
  const before = await page.evaluate("[document.activeElement.value, document.getElementById('shown').innerHTML]");
  await page.press("ArrowRight", 39);
  const after = await page.evaluate("[document.activeElement.value, document.getElementById('shown').innerHTML]");
  assert.notEqual(after[0], before[0], `${name}: a slider does not move`);
  assert.notEqual(after[1], before[1], `${name}: nothing follows the slider`);
  const outline = await page.evaluate("getComputedStyle(document.activeElement).outlineStyle");
  assert.notEqual(outline, "none", `${name}: the focus does not show`);
  for (const scheme of ["light", "dark"]) {
    await page.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: scheme }, { name: "prefers-reduced-motion", value: "reduce" }] });
    const worst = await page.evaluate(CONTRAST);
    assert.ok(worst.ratio >= 4.5, `${name}, ${scheme}: ${JSON.stringify(worst)}`);
  }
  assert.equal(await page.evaluate("document.getAnimations().length"), 0, `${name}: something moves by itself`);
  assert.deepEqual(await page.evaluate(WIDE), [], `${name}: wider than ${WIDTH} px`);
  assert.ok(await page.evaluate("document.documentElement.scrollWidth <= innerWidth"), `${name}: scrolls sideways`);
  assert.deepEqual(await page.evaluate(NAMELESS), [], `${name}: without a name`);
  assert.deepEqual(page.said, [], name);
  await page.close();
}
await browser.close();
process.exit(0);
