// node web/tests/browser/run.mjs COMMAND BROWSER [PICTURES]: the built page in a browser, beside the command.
//
// Every study is dropped, calibrated and saved as a person would, and compared with what the command writes. Wrong files, cancelling, the
// keyboard, narrow screens and the policy are tried. With PICTURES, a folder, what a person sees is saved there.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { browse, open, serve } from "./devtools.mjs";
import { differences } from "./same.mjs";

const [command, program, pictures] = process.argv.slice(2);
const root = resolve(import.meta.dirname ?? new URL(".", import.meta.url).pathname, "../../..");
const STUDIES = [
  ["course", "study.toml", "mount.chain", "secret.csv"], ["mobile-lidar", "study.toml", "mobile-lidar.chain", "measured.csv"],
  ["turntable", "turntable.toml", "turntable.chain", "measured.csv"], ["eye-in-hand", "marks.toml", "arm.chain", "marks.csv"],
  ["probed-arm", "arm.toml", "arm.chain", "poses.csv"], ["mobile-scanner", "walls.toml", "vehicle.chain", "drives.csv"],
  ...["bars arm", "rings arm", "wires arm", "sights theodolite", "targets scanner", "walls scanner"].map((pair) => {
    const [own, chain] = pair.split(" ");
    return ["objects", `${own}.toml`, `${chain}.chain`, `${own}.csv`];
  }),
];

const own = await serve(join(root, "target/web/page")), elsewhere = await serve("/nowhere");
const browser = await browse(program), folder = mkdtempSync(join(tmpdir(), "page-"));
const file = (name, content) => { writeFileSync(join(folder, name), content); return join(folder, name); };
const seen = async (page, name) => { if (pictures) { mkdirSync(pictures, { recursive: true }); writeFileSync(join(pictures, `${name}.png`), await page.picture()); } };
const isShown = (id) => `!document.getElementById("${id}").hidden`;
const textOf = (page, id) => page.evaluate(`document.getElementById("${id}").textContent`);
// A file of the last calibration, saved as a person saves it.
const saved = async (page, name) => {
  const path = mkdtempSync(join(folder, "saved-"));
  await browser.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: path, eventsEnabled: true });
  const done = new Promise((ready) => { browser.listen(({ method, params }) => { if (method === "Browser.downloadProgress" && params.state === "completed") ready(); }); });
  await page.evaluate(`[...document.querySelectorAll("a[download]")].find((link) => link.download === ${JSON.stringify(name)}).click()`);
  await done;
  return readFileSync(join(path, name), "utf8");
};
const calibrate = async (page) => {
  await page.evaluate(`document.getElementById("calibrate").click()`);
  await page.until(`${isShown("result")} || ${isShown("trouble")}`, 180);
  assert.equal(await page.evaluate(isShown("trouble")), false, await textOf(page, "trouble"));
  await page.until(`document.getElementById("cancel").hidden`, 60);
  return page.evaluate(`({ ...document.getElementById("progress").dataset })`);
};

const steps = {
  async "an example from the first click to the corrected table"() {
    const page = await open(browser, own.address);
    await seen(page, "first");
    // By the keyboard alone.
    for (let i = 0; i < 30 && await page.evaluate(`document.activeElement.id !== "example"`); i++) await page.press("Tab", 9);
    await page.press("Enter", 13, "\r");
    await page.until(isShown("read"));
    await seen(page, "read");
    const { seconds } = await calibrate(page);
    console.log(`   from the click to the result ${seconds} s, 160 rows`);
    assert.match(await textOf(page, "badge"), /Effect found|effects found/);
    assert.match(await saved(page, "corrected-secret.csv"), /measured_region/);
    await page.evaluate(`document.getElementById("generate").click()`);
    await page.until(`document.querySelectorAll("#code a").length === 1`);
    await page.until(`document.getElementById("report").src.startsWith("blob:")`);
    await new Promise((done) => { setTimeout(done, 1000); });
    // The script of the report has run in its frame: it makes a picture larger.
    const grown = await Promise.all([...page.frames].map((frame) => page.evaluate(`document.querySelectorAll(".grow").length`, frame).catch(() => 0)));
    assert.ok(Math.max(...grown) > 3, `the report's script has not run: ${grown}`);
    await seen(page, "result");
    assert.deepEqual(page.said, []);
    await page.close();
  },
  async "each study says what the command says"() {
    const page = await open(browser, own.address), others = [];
    for (const [of, study, chain, table] of STUDIES) {
      const at = join(root, "examples", of), out = join(folder, `${of}-${study}`);
      try { execFileSync(command, ["calibrate", join(at, study), "--out", out], { stdio: "pipe" }); } catch (error) { assert.equal(error.status, 1, `${study}: ${error.stderr}`); }
      await page.give("#file", [study, chain, table].map((name) => join(at, name)));
      await page.until(`${isShown("read")} && document.getElementById("study").value === ${JSON.stringify(readFileSync(join(at, study), "utf8"))}`);
      const { seconds, memory } = await calibrate(page);
      const [one, other] = [readFileSync(join(out, "report.json"), "utf8"), await saved(page, "report.json")].map((text) => JSON.parse(text));
      const apart = differences(one, other);
      console.log(`   ${of}/${study}: ${one.verdict ?? ""} ${seconds} s, ${(memory / 1e6).toFixed(0)} MB, ${apart.length} differences`);
      others.push(...apart.map((where) => `${of}/${study}: ${where}`));
      assert.equal(existsSync(join(out, "instrument.toml")), await page.evaluate(`[...document.querySelectorAll("#files a")].some((link) => link.download === "instrument.toml")`));
    }
    assert.deepEqual(others, []);
    assert.deepEqual(page.said, []);
    await page.close();
  },
  async "wrong files are refused in words, and the page goes on"() {
    const page = await open(browser, own.address);
    for (const [name, content, says] of [["empty.csv", "", /empty\.csv/], ["picture.png", Buffer.from([137, 80, 78, 71, 13, 10, 26, 10, 0, 255]), /picture\.png/],
      ["numbers.csv", "1,2\n3,4\n", /first line holds numbers/], ["apples.csv", "apples,pears\n1,2\n", /which kind of instrument/]]) {
      await page.give("#file", [file(name, content)]);
      await page.until(isShown("trouble"));
      assert.match(await textOf(page, "trouble"), says, name);
      await page.evaluate(`document.getElementById("trouble").hidden = true`);
    }
    await page.give("#file", [file("large.csv", Buffer.alloc(100 << 20, "1,2\n"))]);
    await page.until(isShown("trouble"));
    assert.match(await textOf(page, "trouble"), /100 MiB.*Use the command/);
    // A column that is misread, and then read rightly.
    await page.evaluate(`document.getElementById("example").click()`);
    await page.until(`document.getElementById("columns").rows.length > 3`);
    const spoil = (column) => page.evaluate(`(() => { const select = document.querySelector("#columns select"); select.append(new Option("nothing"));
      select.value = ${JSON.stringify(column)}; select.dispatchEvent(new Event("change")); })()`);
    const right = await page.evaluate(`document.querySelector("#columns select").value`);
    await spoil("nothing");
    await page.evaluate(`document.getElementById("calibrate").click()`);
    await page.until(isShown("trouble"));
    assert.match(await textOf(page, "trouble"), /nothing/);
    await spoil(right);
    await calibrate(page);
    assert.deepEqual(page.said, []);
    await page.close();
  },
  async "a calibration can be cancelled, and its memory does not grow"() {
    const page = await open(browser, own.address), memory = [];
    await page.give("#file", ["study.toml", "mobile-lidar.chain", "measured.csv"].map((name) => join(root, "examples/mobile-lidar", name)));
    await page.until(isShown("read"));
    await page.evaluate(`document.getElementById("calibrate").click()`);
    await page.until(`document.getElementById("progress").textContent.includes("search")`);
    await page.evaluate(`document.getElementById("cancel").click()`);
    await page.until(`document.getElementById("progress").textContent === "Stopped."`, 2);
    await page.evaluate(`document.getElementById("example").click()`);
    await page.until(`document.getElementById("study").value.includes("secret.csv")`);
    for (let run = 0; run < 10; run++) memory.push(Number((await calibrate(page)).memory));
    assert.equal(memory[9], memory[2], `the memory of the module grows: ${memory}`);
    assert.deepEqual(page.said, []);
    await page.close();
  },
  async "formulas follow what is typed, and the link carries them"() {
    const page = await open(browser, `${own.address}/#formulas`);
    await page.until(`document.getElementById("answer").textContent.includes("to first order")`);
    await seen(page, "formulas");
    const latex = await page.evaluate(`(async () => { const form = document.getElementById("form"); form.value = "latex"; form.dispatchEvent(new Event("input"));
      for (let i = 0; i < 100 && !document.getElementById("answer").textContent.includes("\\\\"); i++) await new Promise((done) => setTimeout(done, 50));
      return document.getElementById("answer").textContent; })()`);
    for (const [ask, says] of [["identify", /data/], ["bound", /first order|at most/], ["code", /fn |struct /]]) {
      await page.evaluate(`document.getElementById("ask-${ask}").click()`);
      await page.until(`${says}.test(document.getElementById("answer").textContent) && !document.getElementById("answer").classList.contains("wrong")`);
    }
    await page.evaluate(`document.getElementById("ask-check").click(); document.getElementById("formula").value = ${JSON.stringify(latex.split("\n\n")[0].split("\n").slice(1).join("\n"))};
      document.getElementById("formula").dispatchEvent(new Event("input"))`);
    await page.until(`document.getElementById("thinking").textContent === "The formula holds."`);
    const link = await page.evaluate("location.href");
    const other = await open(browser, link);
    await other.until(`document.getElementById("thinking").textContent === "The formula holds."`);
    assert.deepEqual([...page.said, ...other.said], []);
    await other.evaluate(`document.getElementById("declared").value = "chain x {"; document.getElementById("declared").dispatchEvent(new Event("input"))`);
    await other.until(`document.getElementById("answer").classList.contains("wrong")`);
    assert.match(await textOf(other, "answer"), /declaration:1:/);
    await page.close();
    await other.close();
  },
  async "nothing is wider than a phone"() {
    const page = await open(browser, own.address, 400);
    const fits = async () => assert.ok(await page.evaluate("document.documentElement.scrollWidth <= 400"), "the page is wider than the screen");
    await fits();
    await page.evaluate(`document.getElementById("example").click()`);
    await page.until(isShown("read"));
    await fits();
    await calibrate(page);
    await fits();
    await seen(page, "phone");
    await page.evaluate(`location.hash = "#formulas"`);
    await page.until(`document.getElementById("answer").textContent.includes("to first order")`);
    await fits();
    await seen(page, "phone-formulas");
    const nameless = await page.evaluate(`[...document.querySelectorAll("button, a[href], select, textarea, input, iframe")].filter((own) => !own.labels?.length && !own.getAttribute("aria-label")
      && !own.title && !own.textContent.trim()).map((own) => own.outerHTML)`);
    assert.deepEqual(nameless, [], "a control has no name");
    await page.close();
  },
  async "nothing leaves: the policy stops the page, its worker and the report"() {
    const page = await open(browser, own.address), address = JSON.stringify(`${elsewhere.address}/secret`);
    await page.until(`document.getElementById("kind").length > 3`);
    assert.equal(await page.evaluate(`fetch(${address}, { mode: "no-cors" }).then(() => true, () => false)`), false);
    assert.equal(await page.evaluate(`reaches(${address})`), false);
    await page.evaluate(`new Promise((done) => { const picture = new Image(); picture.onload = picture.onerror = done; picture.src = ${address}; })`);
    assert.deepEqual(elsewhere.asked, []);
    assert.ok(own.asked.every((path) => !path.includes("secret") || path === "/examples/secret.csv"));
    await page.close();
  },
};

let failed = 0;
for (const [name, step] of Object.entries(steps)) {
  try { await step(); console.log(`ok ${name}`); } catch (error) { failed++; console.log(`FAILED ${name}: ${error.stack}`); }
}
await browser.close();
own.close();
elsewhere.close();
process.exit(failed ? 1 : 0);
