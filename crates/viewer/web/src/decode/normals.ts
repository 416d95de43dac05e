/**
 * Smooth normals, each facet weighted by its area, packed octahedrally into 16 bits and written to every fourth number of
 * `packed`, whose other three are the position (Meyer et al., "On floating-point normal vectors", 2010).
 */
export function packNormals(packed: Uint16Array, triangles: Uint32Array): void {
  const sums = new Float32Array((packed.length / 4) * 3)
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
    const nx = uy * vz - uz * vy
    const ny = uz * vx - ux * vz
    const nz = ux * vy - uy * vx
    for (let k = 0; k < 3; k++) {
      const s = 3 * triangles[t + k]
      sums[s] += nx
      sums[s + 1] += ny
      sums[s + 2] += nz
    }
  }
  for (let s = 0, p = 3; s < sums.length; s += 3, p += 4) packed[p] = octahedral(sums[s], sums[s + 1], sums[s + 2])
}

function octahedral(x: number, y: number, z: number): number {
  const length = Math.abs(x) + Math.abs(y) + Math.abs(z)
  if (length === 0) return 0x8080
  let u = x / length
  let v = y / length
  if (z < 0) {
    const folded = (1 - Math.abs(v)) * (u < 0 ? -1 : 1)
    v = (1 - Math.abs(u)) * (v < 0 ? -1 : 1)
    u = folded
  }
  return (Math.round(u * 127.5 + 127.5) << 8) | Math.round(v * 127.5 + 127.5)
}
