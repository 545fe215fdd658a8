// A script as a part of an address: #VERSION:DATA, where DATA is the text, deflated with a checksum
// (zlib), in base64 for addresses.
const MOST_BYTES = 1e6; // of a script
const MOST_SIGNS = 32000; // of a fragment: programs that pass addresses on cut longer ones

/** All bytes of a stream, of which there may be `most`. */
async function all(stream, most) {
  const parts = [];
  let size = 0;
  const reader = stream.getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > most) throw new Error(`more than ${most} bytes`);
    parts.push(value);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

/** The fragment of a script, made with a version of celspan. */
export async function fragment(version, source) {
  const bytes = await all(new Blob([source]).stream().pipeThrough(new CompressionStream("deflate")),
    Infinity);
  const text = btoa(Array.from(bytes, code => String.fromCharCode(code)).join(""))
    .replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
  if (text.length > MOST_SIGNS) {
    throw new Error(`The script is too long for an address, ${text.length} characters: at most ${
      MOST_SIGNS} are possible. Send it as a file.`);
  }
  return `#${version}:${text}`;
}

/** { version, source } of a fragment; null: it has no script. */
export async function shared(hash) {
  if (!hash.includes(":")) return null;
  try {
    const [, version, text] = hash.match(/^#(\d+\.\d+\.\d+):([\w-]+)$/);
    const bytes = Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")),
      sign => sign.charCodeAt(0));
    const source = await all(new Blob([bytes]).stream().pipeThrough(
      new DecompressionStream("deflate")), MOST_BYTES);
    return { version, source: new TextDecoder("utf-8", { fatal: true }).decode(source) };
  } catch {
    throw new Error("The script in this address is damaged. Ask for the address again.");
  }
}
