// The module in its worker: asks it for work, hears of progress, stops it.
import { decoded, text } from "./message.js";

/** Why work gave no answer: the person stopped it. */
export class Stopped extends Error {}

let compiled;
const module = () => (compiled ??= (async () => {
  const response = await fetch("trueaxis.wasm");
  if (!response.ok) throw new Error(`The module could not be loaded (${response.status}). Reload the page.`);
  return WebAssembly.compile(await response.arrayBuffer());
})().catch((error) => { compiled = undefined; throw error; }));

/** Loads the module before somebody needs it. */
export const prepare = () => module();

// A worker made of a blob has the policy of the page: nothing that it does can reach another address.
const source = () => URL.createObjectURL(new Blob([`import ${JSON.stringify(new URL("worker.js", import.meta.url).href)};
postMessage({ begun: true });`], { type: "text/javascript" }));

export class Engine {
  #worker = null;
  #stop = null;

  /** Asks for work: a list of [name, text or bytes]. `tell` hears what is being done. Gives the parts of the answer. */
  async ask(parts, tell = () => {}) {
    this.stop();
    let stopped = false;
    const cancelled = new Promise((_, reject) => { this.#stop = () => { stopped = true; reject(new Stopped()); }; });
    cancelled.catch(() => {});
    const worker = await Promise.race([this.#started(() => stopped), cancelled]);
    const answered = new Promise((resolve, reject) => {
      let last = "";
      worker.onmessage = ({ data }) => {
        if (data.told !== undefined) { last = data.told; tell(last); }
        if (data.answer) { this.memory = data.memory; resolve(decoded(data.answer)); }
        if (data.failed) {
          this.#end();
          reject(new Error(`${last.startsWith("the module failed") ? last : data.failed}. This is a mistake in the program. Please report it with the table, if you may share it.`));
        }
      };
      worker.onerror = (error) => { this.#end(); reject(new Error(error.message || "The worker could not be started.")); };
      worker.postMessage({ parts });
    });
    try {
      const answer = await Promise.race([answered, cancelled]);
      if (text(answer, "status") === "refused") throw new Error(text(answer, "why"));
      return answer;
    } finally {
      this.#stop = null;
    }
  }

  /** Ends what is being done, if anything is. */
  stop() {
    if (!this.#stop) return;
    this.#stop();
    this.#stop = null;
    this.#end();
  }

  /** Whether the worker can reach an address. */
  async reaches(address) {
    const worker = await this.#started(() => false);
    return new Promise((resolve) => {
      worker.onmessage = ({ data }) => { if ("left" in data) resolve(data.left); };
      worker.postMessage({ probe: address });
    });
  }

  async #started(isStopped) {
    if (this.#worker) return this.#worker;
    const own = await module();
    if (isStopped()) throw new Stopped();
    const address = source(), worker = new Worker(address, { type: "module" });
    this.#worker = worker;
    await new Promise((resolve, reject) => {
      worker.onmessage = ({ data }) => {
        if (data.begun) worker.postMessage({ module: own });
        if (data.ready) resolve();
      };
      worker.onerror = (error) => { this.#end(); reject(new Error(error.message || "The worker could not be started.")); };
    });
    URL.revokeObjectURL(address);
    return worker;
  }

  #end() {
    this.#worker?.terminate();
    this.#worker = null;
  }
}
