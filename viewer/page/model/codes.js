// Decodes columns of the payload. Every code gives back the bits that the record's text stood for; viewer/column_code.hpp
// describes the codes and chooses among them.

const integers = {i8: Int8Array, i16: Int16Array, i32: Int32Array, u8: Uint8Array, u16: Uint16Array, u32: Uint32Array};

/** A typed array copied out of the payload, so that its place there need not be aligned. */
function array_at(bytes, type, at, count) {
  const size = count * type.BYTES_PER_ELEMENT;
  if (at + size > bytes.length) throw new Error(`the payload ends at ${bytes.length}, a column at ${at + size}`);
  return new type(bytes.slice(at, at + size).buffer);
}

/** Integers that stand for multiples of a step, or for fractions; the three lowest stand for null, +inf and -inf. */
function scaled(code, bytes) {
  const type = integers[code.type];
  const whole = array_at(bytes, type, code.at, code.count);
  const values = new Float64Array(code.count);
  const lowest = -(2 ** (8 * type.BYTES_PER_ELEMENT - 1));
  let k = 0;
  for (let i = 0; i < code.count; ++i) {
    k = code.delta ? k + whole[i] : whole[i];
    values[i] = code.by ? k / code.by : k * code.step;
    if (code.delta || k > lowest + 2) continue;
    values[i] = k === lowest ? NaN : k === lowest + 1 ? Infinity : -Infinity;
  }
  return values;
}

/** Doubles, each XORed with the one before it, as eight planes of bytes, the lowest first. */
function planes(code, bytes) {
  const {at, count} = code;
  if (at + 8 * count > bytes.length) throw new Error(`the payload ends at ${bytes.length}, a column at ${at + 8 * count}`);
  const result = new Uint8Array(8 * count);
  for (let plane = 0; plane < 8; ++plane) {
    let before = 0;
    for (let i = 0; i < count; ++i) result[8 * i + plane] = before ^= bytes[at + plane * count + i];
  }
  return new Float64Array(result.buffer);
}

/** The numbers of a column. */
export function numbers(code, bytes) {
  if (code.kind === 'constant') return new Float64Array(code.count).fill(code.value);
  if (code.kind === 'planes') return planes(code, bytes);
  if (code.kind === 'scaled') return scaled(code, bytes);
  throw new Error(`there is no code ${JSON.stringify(code.kind)} of numbers`);
}

/** The names of a column: row r is levels[level[r]]. */
export function names(code, bytes) {
  return {levels: code.levels, level: array_at(bytes, integers[code.type], code.at, code.count)};
}

/** Lists of numbers: row r has values[starts[r]] up to values[starts[r + 1]]. */
export function lists(code, bytes) {
  const lengths = numbers(code.lengths, bytes);
  const starts = new Uint32Array(lengths.length + 1);
  lengths.forEach((length, r) => { starts[r + 1] = starts[r] + length; });
  return {starts, values: numbers(code.values, bytes)};
}
