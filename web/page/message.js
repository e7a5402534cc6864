// What goes between the page and its module: parts with names, each as long as it says (the twin of web/src/message.rs).
const encoder = new TextEncoder(), decoder = new TextDecoder();

/** The bytes of parts: a list of [name, text or bytes]. */
export function encoded(parts) {
  const pieces = parts.flatMap(([name, content]) => [encoder.encode(name), typeof content === "string" ? encoder.encode(content) : content]);
  const bytes = new Uint8Array(pieces.reduce((sum, piece) => sum + 4 + piece.length, 0)), view = new DataView(bytes.buffer);
  let at = 0;
  for (const piece of pieces) {
    view.setUint32(at, piece.length, true);
    bytes.set(piece, at + 4);
    at += 4 + piece.length;
  }
  return bytes;
}

/** The parts in some bytes, by their names. */
export function decoded(bytes) {
  const parts = new Map(), view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = 0;
  const piece = () => {
    const length = view.getUint32(at, true), own = bytes.subarray(at + 4, at + 4 + length);
    at += 4 + length;
    return own;
  };
  while (at < bytes.length) parts.set(decoder.decode(piece()), piece());
  return parts;
}

/** A part as text. */
export const text = (parts, name) => decoder.decode(parts.get(name) ?? new Uint8Array());
