/**
 * The triangle code of EXT_meshopt_compression (glTF extension, mode TRIANGLES): most triangles share an edge with one of the
 * last sixteen and are one byte; the rest name their corners by the last sixteen vertices, by "the next new one", or outright.
 */
export function decodeTriangles(code: Uint8Array, out: Uint32Array): void {
  const triangles = out.length / 3
  const version = code[0] & 0x0f
  if ((code[0] & 0xf0) !== 0xe0 || version > 1) throw new Error('unknown triangle code')
  const lastFifo = version >= 1 ? 13 : 15
  const pairs = code.length - 16
  if (1 + triangles > pairs) throw new Error('triangle code is cut short')

  const edges = new Uint32Array(32)
  const vertices = new Uint32Array(16)
  let edgeAt = 0
  let vertexAt = 0
  let next = 0
  let last = 0
  let data = 1 + triangles

  const pushEdge = (a: number, b: number) => {
    edges[2 * edgeAt] = a
    edges[2 * edgeAt + 1] = b
    edgeAt = (edgeAt + 1) & 15
  }
  const pushVertex = (v: number) => {
    vertices[vertexAt] = v
    vertexAt = (vertexAt + 1) & 15
  }
  /** A vertex named by its difference from the last one so named. */
  const free = () => {
    let value = 0
    let shift = 0
    let byte
    do {
      if (data >= pairs || shift > 28) throw new Error('triangle code is damaged')
      byte = code[data++]
      value |= (byte & 127) << shift
      shift += 7
    } while (byte & 128)
    last = (last + ((value >>> 1) ^ -(value & 1))) >>> 0
    return last
  }

  for (let t = 0; t < triangles; t++) {
    const head = code[1 + t]
    let a: number, b: number, c: number
    if (head < 0xf0) {
      const edge = (edgeAt - 1 - (head >> 4)) & 15
      const how = head & 15
      a = edges[2 * edge]
      b = edges[2 * edge + 1]
      if (how < lastFifo) {
        c = how === 0 ? next++ : vertices[(vertexAt - 1 - how) & 15]
        if (how === 0) pushVertex(c)
      } else {
        c = how === 15 ? free() : (last = (last + (how - (how ^ 3))) >>> 0)
        pushVertex(c)
      }
      pushEdge(c, b)
      pushEdge(a, c)
    } else if (head < 0xfe) {
      const pair = code[pairs + (head & 15)]
      const hb = pair >> 4
      const hc = pair & 15
      a = next++
      b = hb === 0 ? next++ : vertices[(vertexAt - hb) & 15]
      c = hc === 0 ? next++ : vertices[(vertexAt - hc) & 15]
      pushVertex(a)
      if (hb === 0) pushVertex(b)
      if (hc === 0) pushVertex(c)
      pushEdge(b, a)
      pushEdge(c, b)
      pushEdge(a, c)
    } else {
      const pair = code[data++]
      const ha = head === 0xfe ? 0 : 15
      const hb = pair >> 4
      const hc = pair & 15
      if (pair === 0) next = 0
      a = ha === 0 ? next++ : 0
      b = hb === 0 ? next++ : vertices[(vertexAt - hb) & 15]
      c = hc === 0 ? next++ : vertices[(vertexAt - hc) & 15]
      if (ha === 15) a = free()
      if (hb === 15) b = free()
      if (hc === 15) c = free()
      pushVertex(a)
      if (hb === 0 || hb === 15) pushVertex(b)
      if (hc === 0 || hc === 15) pushVertex(c)
      pushEdge(b, a)
      pushEdge(c, b)
      pushEdge(a, c)
    }
    out[3 * t] = a
    out[3 * t + 1] = b
    out[3 * t + 2] = c
  }
}
