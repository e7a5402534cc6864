// A browser without a window, driven by its own protocol through a pipe: nothing is needed but node and the browser.
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";

const TYPES = { ".html": "text/html; charset=utf-8", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".txt": "text/plain; charset=utf-8" };

/** Serves a folder on this machine; without a folder it finds nothing. Gives the address, and counts what was asked for. */
export async function serve(folder) {
  const asked = [];
  const server = createServer((request, response) => {
    const path = normalize(new URL(request.url, "http://page").pathname);
    asked.push(path);
    try {
      const bytes = readFileSync(join(folder, path === "/" ? "index.html" : path));
      response.writeHead(200, { "content-type": TYPES[path === "/" ? ".html" : extname(path)] ?? "application/octet-stream" });
      response.end(bytes);
    } catch { response.writeHead(404).end(); }
  });
  await new Promise((done) => { server.listen(0, "127.0.0.1", done); });
  return { address: `http://127.0.0.1:${server.address().port}`, asked, close: () => server.close() };
}

/** Starts a browser. */
export async function browse(program) {
  const profile = mkdtempSync(join(tmpdir(), "browser-"));
  const child = spawn(program, ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking", "--disable-component-update",
    "--disable-sync", "--remote-debugging-pipe", `--user-data-dir=${profile}`, "about:blank"], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
  const [, , , into, from] = child.stdio, waiting = new Map(), listeners = [];
  let next = 1, rest = "";
  from.setEncoding("utf8");
  from.on("data", (text) => {
    const messages = (rest + text).split("\0");
    rest = messages.pop();
    for (const message of messages.map((own) => JSON.parse(own))) {
      if (message.id === undefined) { listeners.forEach((listener) => listener(message)); continue; }
      const { resolve, reject } = waiting.get(message.id);
      waiting.delete(message.id);
      if (message.error) reject(new Error(message.error.message)); else resolve(message.result);
    }
  });
  const send = (method, params = {}, sessionId = undefined) => new Promise((resolve, reject) => {
    waiting.set(next, { resolve, reject });
    into.write(`${JSON.stringify({ id: next++, method, params, sessionId })}\0`);
  });
  return { send, listen: (listener) => listeners.push(listener), profile, close: async () => { await send("Browser.close").catch(() => {}); child.kill(); } };
}

/** Opens a tab; what its console says of mistakes is gathered in `said`. */
export async function open(browser, address, width = 1280) {
  const { targetId } = await browser.send("Target.createTarget", { url: "about:blank" });
  const { sessionId } = await browser.send("Target.attachToTarget", { targetId, flatten: true });
  const said = [], frames = new Set([sessionId]);
  browser.listen(({ method, params, sessionId: from }) => {
    if (method === "Target.attachedToTarget" && from === sessionId && params.targetInfo.type === "iframe") frames.add(params.sessionId);
    if (from !== sessionId) return;
    if (method === "Log.entryAdded" && params.entry.level === "error") said.push(`${params.entry.text} ${params.entry.url ?? ""}`);
    if (method === "Runtime.exceptionThrown") said.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
  });
  const send = (method, params) => browser.send(method, params, sessionId);
  await Promise.all(["Page.enable", "Runtime.enable", "Log.enable", "DOM.enable"].map((method) => send(method)));
  await send("Target.setAutoAttach", { autoAttach: true, waitForDebuggerOnStart: false, flatten: true });
  await send("Emulation.setDeviceMetricsOverride", { width, height: 900, deviceScaleFactor: 1, mobile: false });
  const evaluate = async (expression, session = sessionId) => {
    const { result, exceptionDetails } = await browser.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true, userGesture: true }, session);
    if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description ?? exceptionDetails.text}`);
    return result.value;
  };
  const until = async (expression, seconds = 60) => {
    for (const end = Date.now() + seconds * 1000; Date.now() < end;) {
      if (await evaluate(expression)) return;
      await new Promise((done) => { setTimeout(done, 50); });
    }
    throw new Error(`after ${seconds} s this is still not so: ${expression}; the page says: ${await evaluate("document.body.innerText.slice(0, 1500)")}`);
  };
  const give = async (selector, files) => {
    const { root } = await send("DOM.getDocument"), { nodeId } = await send("DOM.querySelector", { nodeId: root.nodeId, selector });
    await send("DOM.setFileInputFiles", { nodeId, files });
  };
  const press = async (key, code, text) => {
    const own = { key, code: key, windowsVirtualKeyCode: code, text };
    await send("Input.dispatchKeyEvent", { type: "keyDown", ...own });
    await send("Input.dispatchKeyEvent", { type: "keyUp", ...own });
  };
  const picture = async () => Buffer.from((await send("Page.captureScreenshot", { captureBeyondViewport: true })).data, "base64");
  await send("Page.navigate", { url: address });
  await until("document.readyState === 'complete'");
  return { send, evaluate, until, give, press, picture, said, frames, close: () => browser.send("Target.closeTarget", { targetId }) };
}
