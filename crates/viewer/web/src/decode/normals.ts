/** Cosine of the angle between a facet and the mean around one of its corners from which on the corner lies on a crease. */
const CREASE = Math.cos((15 * Math.PI) / 180)

/** Stands for the normal of a vertex on a crease, where there is none that its facets share. */
export const NO_NORMAL = 0

/**
 * Smooth normals, each facet weighted by its area, packed octahedrally into 16 bits and written to every fourth number of
 * `packed`, whose other three are the position (Meyer et al., "On floating-point normal vectors", 2010). Where a facet
 * departs more than 15 degrees from the mean (two facets of an edge by 30 degrees from each other) there is none.
 */
export function packNormals(packed: Uint16Array, triangles: Uint32Array): void {
  const sums = new Float32Array((packed.length / 4) * 3)
  eachFacet(packed, triangles, (t, x, y, z) => {
    for (let k = 0; k < 3; k++) {
      const s = 3 * triangles[t + k]
      sums[s] += x
      sums[s + 1] += y
      sums[s + 2] += z
    }
  })
  for (let s = 0, p = 3; s < sums.length; s += 3, p += 4) packed[p] = octahedral(sums[s], sums[s + 1], sums[s + 2])
  eachFacet(packed, triangles, (t, x, y, z) => {
    const own = x * x + y * y + z * z
    for (let k = 0; k < 3; k++) {
      const s = 3 * triangles[t + k]
      const a = sums[s]
      const b = sums[s + 1]
      const c = sums[s + 2]
      const along = x * a + y * b + z * c
      // Facets without area lean nowhere.
      if (own > 0 && (along <= 0 || along * along < CREASE * CREASE * own * (a * a + b * b + c * c))) packed[4 * triangles[t + k] + 3] = NO_NORMAL
    }
  })
}

/** Calls `visit` with each facet and its normal, as long as twice its area. */
function eachFacet(packed: Uint16Array, triangles: Uint32Array, visit: (t: number, x: number, y: number, z: number) => void): void {
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 4 * triangles[t]
    const b = 4 * triangles[t + 1]
    const c = 4 * triangles[t + 2]
    const ux = packed[b] - packed[a]
    const uy = packed[b + 1] - packed[a + 1]
    const uz = packed[b + 2] - packed[a + 2]
    const vx = packed[c] - packed[a]
    const vy = packed[c + 1] - packed[a + 1]
    const vz = packed[c + 2] - packed[a + 2]
    visit(t, uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx)
  }
}

/** [`NO_NORMAL`] only where there is no direction; the code beside it is the same one within a step. */
export function octahedral(x: number, y: number, z: number): number {
  const length = Math.abs(x) + Math.abs(y) + Math.abs(z)
  if (length === 0) return NO_NORMAL
  let u = x / length
  let v = y / length
  if (z < 0) {
    const folded = (1 - Math.abs(v)) * (u < 0 ? -1 : 1)
    v = (1 - Math.abs(u)) * (v < 0 ? -1 : 1)
    u = folded
  }
  return Math.max(1, (Math.round(u * 127.5 + 127.5) << 8) | Math.round(v * 127.5 + 127.5))
}
