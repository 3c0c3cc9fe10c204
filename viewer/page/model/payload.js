// Unpacks what the page carries: base64 of gzip of a container, which viewer/payload.hpp describes.

const magic = 'MUSTERV1';

function from_base64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

export async function unzipped(text) {
  const stream = new Blob([from_base64(text.trim())]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** {head, bytes}: the container's description as an object, and the columns' bytes that it refers to. */
export function opened(container) {
  const text = new TextDecoder();
  if (text.decode(container.subarray(0, 8)) !== magic) throw new Error('this page carries no run');
  const length = new DataView(container.buffer, container.byteOffset).getUint32(8, true);
  return {head: JSON.parse(text.decode(container.subarray(12, 12 + length))), bytes: container.subarray(12 + length)};
}
