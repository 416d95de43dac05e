/**
 * For each vertex the earlier ones it is predicted from: four numbers a vertex, `kind, a, b, c`.
 * The writer's rules exactly: vertices stand in order of first use, known corners come in the triangle's order, and the
 * neighbor across an edge is sought among the last sixteen triangles.
 */
export const ZERO = 0
export const LIKE = 1
export const BETWEEN = 2
export const ACROSS = 3
const WINDOW = 16

export function rules(triangles: Uint32Array, vertices: number): Uint32Array {
  const out = new Uint32Array(4 * vertices)
  let known = 0
  for (let t = 0; t < triangles.length && known < vertices; t += 3) {
    for (;;) {
      // The lowest corner that is new; a triangle has at most three.
      let fresh = -1
      for (let k = 0; k < 3; k++) {
        const v = triangles[t + k]
        if (v >= known && (fresh < 0 || v < fresh)) fresh = v
      }
      if (fresh < 0) break
      if (fresh !== known) throw new Error('vertices are out of order')
      let a = -1
      let b = -1
      for (let k = 0; k < 3; k++) {
        const v = triangles[t + k]
        if (v < fresh) {
          if (a < 0) a = v
          else if (b < 0) b = v
        }
      }
      write(out, fresh, a, b, triangles, t)
      known++
    }
  }
  if (known !== vertices) throw new Error('vertices are missing')
  return out
}

function write(out: Uint32Array, v: number, a: number, b: number, triangles: Uint32Array, t: number): void {
  const at = 4 * v
  if (b >= 0) {
    const c = across(triangles, t, a, b)
    out[at] = c >= 0 ? ACROSS : BETWEEN
    out[at + 1] = a
    out[at + 2] = b
    out[at + 3] = c >= 0 ? c : 0
  } else if (a >= 0 || v > 0) {
    out[at] = LIKE
    out[at + 1] = a >= 0 ? a : v - 1
  }
}

/** Third corner of the latest earlier triangle that has both `a` and `b`, or −1. */
function across(triangles: Uint32Array, t: number, a: number, b: number): number {
  for (let e = t - 3; e >= 0 && e >= t - 3 * WINDOW; e -= 3) {
    const x = triangles[e]
    const y = triangles[e + 1]
    const z = triangles[e + 2]
    if ((x === a || y === a || z === a) && (x === b || y === b || z === b)) return x !== a && x !== b ? x : y !== a && y !== b ? y : z
  }
  return -1
}
