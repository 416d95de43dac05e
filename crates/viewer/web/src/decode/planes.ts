/** Differences out of planes of bytes, lowest plane first, unfolded (0, 1, 2, 3 → 0, −1, 1, −2). */
export function differences(bytes: Uint8Array, offset: number, count: number, width: number): Int32Array {
  if (bytes.length < offset + count * width) throw new Error('a blob is cut short')
  const out = new Int32Array(count)
  for (let i = 0; i < count; i++) {
    let folded = 0
    for (let plane = 0; plane < width; plane++) folded |= bytes[offset + plane * count + i] << (8 * plane)
    out[i] = (folded >>> 1) ^ -(folded & 1)
  }
  return out
}

/** The sum of prediction and difference on the circle of `width` bytes, above or below zero alike. */
export function wrapSigned(value: number, width: number): number {
  const shift = 32 - 8 * width
  return (value << shift) >> shift
}
