import { NO_NORMAL } from './normals'

/** Facets that meet at more than this angle have an edge between them, as they have in the light. */
const CREASE = (30 * Math.PI) / 180
/** Steps that rounding to the grid can tilt a facet by, over its height: half a step along each axis, at either end. */
const ROUNDING = 1.75

/** The edges at which a surface turns sharply. */
export interface SharpEdges {
  /** Two vertices each. */
  ends: Uint32Array
  /** Length of all of them, and area of the surface, in steps of the grid. */
  length: number
  area: number
}

/**
 * Finds the edges between facets that meet at more than 30 degrees, by more than rounding to the grid can have turned them.
 * Vertices at one place of the grid are one, so that facets meet which have no vertex in common. Free edges are none, nor is
 * an edge where a facet lies on another. `packed` has its normals already: of a smooth surface no edge is looked at.
 */
export function sharpEdges(packed: Uint16Array, triangles: Uint32Array): SharpEdges {
  const { place, folded } = places(packed)
  const area = new Area(packed)
  const looked = (p: number, q: number) => p !== q && folded[p] === 1 && folded[q] === 1
  let [sum, length, corners] = [0, 0, 0]
  for (let h = 0; h < triangles.length; h++) {
    if (h % 3 === 0) sum += area.of(triangles, h)
    if (looked(place[triangles[h]], place[triangles[next(h)]])) corners++
  }
  const table = new EdgeTable(corners)
  const ends: number[] = []
  for (let h = 0; h < triangles.length; h++) {
    const [a, b] = [triangles[h], triangles[next(h)]]
    const [p, q] = [place[a], place[b]]
    if (!looked(p, q)) continue
    const other = table.meet(p, q, h)
    if (other < 0 || !sharp(packed, triangles, place, other, h)) continue
    table.done(p, q)
    ends.push(a, b)
    length += Math.hypot(...[0, 1, 2].map((k) => packed[4 * a + k] - packed[4 * b + k]))
  }
  return { ends: Uint32Array.from(ends), length, area: sum }
}

/** The next corner of the same triangle. */
const next = (h: number): number => (h % 3 === 2 ? h - 2 : h + 1)

/** For each vertex the first one at its place, and for that whether it can lie on an edge: it has no normal, or is several. */
function places(packed: Uint16Array): { place: Uint32Array; folded: Uint8Array } {
  const count = packed.length / 4
  const place = new Uint32Array(count)
  const folded = new Uint8Array(count)
  const size = 2 ** Math.ceil(Math.log2(2 * count + 2))
  const slots = new Int32Array(size).fill(-1)
  for (let v = 0, p = 0; v < count; v++, p += 4) {
    let slot = (Math.imul(packed[p], 73856093) ^ Math.imul(packed[p + 1], 19349663) ^ Math.imul(packed[p + 2], 83492791)) & (size - 1)
    for (; slots[slot] >= 0; slot = (slot + 1) & (size - 1)) {
      const q = 4 * slots[slot]
      if (packed[p] === packed[q] && packed[p + 1] === packed[q + 1] && packed[p + 2] === packed[q + 2]) break
    }
    if (slots[slot] < 0) slots[slot] = v
    else folded[slots[slot]] = 1
    place[v] = slots[slot]
    if (packed[p + 3] === NO_NORMAL) folded[place[v]] = 1
  }
  return { place, folded }
}

/** Which corner an edge was first met at, by the places at its ends. */
class EdgeTable {
  private readonly size: number
  private readonly slots: Int32Array
  private readonly keys: Uint32Array

  /** For as many corners as will be met. */
  constructor(corners: number) {
    this.size = 2 ** Math.ceil(Math.log2(1.5 * corners + 2))
    this.slots = new Int32Array(this.size).fill(-1)
    this.keys = new Uint32Array(2 * this.size)
  }

  /** The corner that the edge was met at before, -1 where it was not, -2 where it has been done. */
  meet(p: number, q: number, corner: number): number {
    const slot = this.find(p, q)
    const met = this.slots[slot]
    if (met === -1) this.slots[slot] = corner
    return met
  }

  done(p: number, q: number): void {
    this.slots[this.find(p, q)] = -2
  }

  private find(p: number, q: number): number {
    const [low, high] = p < q ? [p, q] : [q, p]
    let slot = (Math.imul(low, 73856093) ^ Math.imul(high, 19349663)) & (this.size - 1)
    while (this.slots[slot] !== -1 && (this.keys[2 * slot] !== low || this.keys[2 * slot + 1] !== high)) slot = (slot + 1) & (this.size - 1)
    this.keys[2 * slot] = low
    this.keys[2 * slot + 1] = high
    return slot
  }
}

/** Areas and directions of facets, in steps of the grid. */
class Area {
  /** Twice the area along each axis. */
  readonly normal = [0, 0, 0]
  /** The longest side. */
  longest = 0

  constructor(private readonly packed: Uint16Array) {}

  of(triangles: Uint32Array, t: number): number {
    const { packed, normal } = this
    const [a, b, c] = [4 * triangles[t], 4 * triangles[t + 1], 4 * triangles[t + 2]]
    const [ux, uy, uz] = [packed[b] - packed[a], packed[b + 1] - packed[a + 1], packed[b + 2] - packed[a + 2]]
    const [vx, vy, vz] = [packed[c] - packed[a], packed[c + 1] - packed[a + 1], packed[c + 2] - packed[a + 2]]
    normal[0] = uy * vz - uz * vy
    normal[1] = uz * vx - ux * vz
    normal[2] = ux * vy - uy * vx
    const square = (x: number, y: number, z: number) => x * x + y * y + z * z
    this.longest = Math.sqrt(Math.max(square(ux, uy, uz), square(vx, vy, vz), square(ux - vx, uy - vy, uz - vz)))
    return 0.5 * Math.sqrt(square(normal[0], normal[1], normal[2]))
  }
}

/** Whether the facets of two corners, which have the edge that begins at each, surely meet at more than the angle. */
function sharp(packed: Uint16Array, triangles: Uint32Array, place: Uint32Array, g: number, h: number): boolean {
  // One lies on the other.
  if (place[triangles[next(next(g))]] === place[triangles[next(next(h))]]) return false
  const [one, two] = [new Area(packed), new Area(packed)]
  const [a, b] = [one.of(triangles, g - (g % 3)), two.of(triangles, h - (h % 3))]
  if (a === 0 || b === 0) return false
  // Facets of one orientation run along their edge in opposite ways.
  const along = place[triangles[g]] === place[triangles[h]] ? -1 : 1
  const [[ax, ay, az], [bx, by, bz]] = [one.normal, two.normal]
  const cosine = (along * (ax * bx + ay * by + az * bz)) / (4 * a * b)
  const tilt = (area: number, longest: number) => Math.atan((ROUNDING * longest) / (2 * area))
  return Math.acos(Math.min(1, Math.max(-1, cosine))) > CREASE + tilt(a, one.longest) + tilt(b, two.longest)
}
