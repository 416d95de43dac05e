/** Cells along a side of the grid. */
const SIDE = 64
const CELL = 65536 / SIDE

/**
 * How far edges lie from their neighbors, in steps of the grid: where a surface runs through a cell, its area for each length of the
 * edges in it. Of an edge that leads through several cells, where it has most room. `ends`: two vertices of `packed` an edge.
 */
export function roomOf(packed: Uint16Array, ends: Uint32Array): Float32Array {
  const room = new Float32Array(ends.length / 2).fill(Infinity)
  if (ends.length === 0) return room
  // What lies in the corner of a cell by itself is in the middle of one of the second grid.
  for (const shift of [0, CELL / 2]) {
    const lengths = new Float32Array((SIDE + 1) ** 3)
    const here = new Float32Array(room.length)
    each(packed, ends, shift, (_, cell, length) => (lengths[cell] += length))
    each(packed, ends, shift, (edge, cell) => (here[edge] = Math.max(here[edge], CELL ** 2 / lengths[cell])))
    for (let edge = 0; edge < room.length; edge++) room[edge] = Math.min(room[edge], here[edge])
  }
  return room
}

/** Calls `visit` with each edge, the cells that it leads through, and its length in them, to within a cell. */
function each(packed: Uint16Array, ends: Uint32Array, shift: number, visit: (edge: number, cell: number, length: number) => void): void {
  const along = (x: number) => Math.floor((x + shift) / CELL)
  for (let i = 0; i < ends.length; i += 2) {
    const [p, q] = [4 * ends[i], 4 * ends[i + 1]]
    const [x, y, z] = [packed[p], packed[p + 1], packed[p + 2]]
    const [u, v, w] = [packed[q] - x, packed[q + 1] - y, packed[q + 2] - z]
    const length = Math.sqrt(u * u + v * v + w * w)
    const parts = 1 + Math.floor(length / CELL)
    for (let k = 0; k < parts; k++) {
      const t = (k + 0.5) / parts
      const cell = (along(x + t * u) * (SIDE + 1) + along(y + t * v)) * (SIDE + 1) + along(z + t * w)
      visit(i / 2, cell, length / parts)
    }
  }
}
