// Runs the module beside the page, so that the page answers meanwhile. One message at a time; to stop it, the page ends the worker.
import { encoded } from "./message.js";

let exported;
const tell = (at, length) => postMessage({ told: new TextDecoder().decode(new Uint8Array(exported.memory.buffer, at, length)) });

addEventListener("message", async ({ data: { module, parts, probe } }) => {
  if (module) {
    exported = (await WebAssembly.instantiate(module, { page: { tell } })).exports;
    postMessage({ ready: true });
    return;
  }
  // For the test that nothing leaves: asks for an address elsewhere, which the policy of the page forbids.
  if (probe) {
    const left = await fetch(probe, { mode: "no-cors" }).then(() => true, () => false);
    postMessage({ left });
    return;
  }
  try {
    const bytes = encoded(parts);
    const at = exported.room(bytes.length);
    new Uint8Array(exported.memory.buffer, at, bytes.length).set(bytes);
    const length = exported.answer();
    const answer = new Uint8Array(exported.memory.buffer, exported.answer_at(), length).slice();
    postMessage({ answer, memory: exported.memory.buffer.byteLength }, [answer.buffer]);
  } catch (error) {
    postMessage({ failed: String(error) });
  }
});
