/** Cells along a side of the grid. */
const SIDE = 64
const CELL = 65536 / SIDE

/**
 * How far edges lie from their neighbors, in steps of the grid: where a surface runs through a cell, its area for each length of the
 * edges in it. Of an edge that leads through several cells, where it has most room. `ends`: two vertices of `packed` an edge.
 */
export function roomOf(packed: Uint16Array, ends: Uint32Array): Float32Array {
  const room = new Float32Array(ends.length / 2)
  if (ends.length === 0) return room
  const lengths = new Float32Array(SIDE ** 3)
  each(packed, ends, (_, cell, length) => (lengths[cell] += length))
  each(packed, ends, (edge, cell) => (room[edge] = Math.max(room[edge], CELL ** 2 / lengths[cell])))
  return room
}

/** Calls `visit` with each edge, the cells that it leads through, and its length in them, to within a cell. */
function each(packed: Uint16Array, ends: Uint32Array, visit: (edge: number, cell: number, length: number) => void): void {
  for (let i = 0; i < ends.length; i += 2) {
    const [p, q] = [4 * ends[i], 4 * ends[i + 1]]
    const [x, y, z] = [packed[p], packed[p + 1], packed[p + 2]]
    const [u, v, w] = [packed[q] - x, packed[q + 1] - y, packed[q + 2] - z]
    const length = Math.sqrt(u * u + v * v + w * w)
    const parts = 1 + Math.floor(length / CELL)
    for (let k = 0; k < parts; k++) {
      const t = (k + 0.5) / parts
      const cell = ((Math.floor((x + t * u) / CELL) * SIDE + Math.floor((y + t * v) / CELL)) * SIDE) + Math.floor((z + t * w) / CELL)
      visit(i / 2, cell, length / parts)
    }
  }
}
