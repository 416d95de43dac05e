import { roomOf } from './crowding'
import { mixed } from './hash'
import { NO_NORMAL } from './normals'

/** Facets that meet at more than this angle have an edge between them, as they have in the light. */
const CREASE = (30 * Math.PI) / 180
/** Steps that rounding to the grid can tilt a facet by, over its height: half a step along each axis, at either end. */
const ROUNDING = 1.75
/** Rows of edges up to this long are short: a thirtieth of the largest extent, in steps of the grid. */
const SHORT = 65535 / 30

/** The edges at which a surface turns sharply. */
export interface SharpEdges {
  /** Two vertices each. */
  ends: Uint32Array
  /** Four numbers a place, where they are not vertices of the surface. */
  places: Uint16Array | null
  /** How far each lies from its neighbors, in steps of the grid. */
  room: Float32Array
  /** Area of the surface, in steps of the grid. */
  area: number
}

/**
 * Finds the edges between facets that meet at more than 30 degrees, by more than rounding to the grid can have turned them.
 * Vertices at one place of the grid are one, so that facets meet which have no vertex in common. Boundary edges are none, nor is
 * an edge where a facet lies on another, nor a short row of edges that ends on the surface: such are of its roughness.
 * `packed` has its normals already: of a smooth surface no edge is looked at.
 */
export function sharpEdges(packed: Uint16Array, triangles: Uint32Array): SharpEdges {
  const { place, folded } = places(packed)
  let corners = 0
  for (let h = 0; h < triangles.length; h++) if (folded[place[triangles[h]]] === 1) corners++
  const found: number[] = []
  const table = new EdgeTable(corners)
  for (let h = 0; corners > 0 && h < triangles.length; h++) {
    const p = place[triangles[h]]
    if (folded[p] === 0) continue
    const q = place[triangles[next(h)]]
    if (p === q || folded[q] === 0) continue
    const other = table.meet(p, q, h)
    if (other < 0 || !sharp(packed, triangles, place, other, h)) continue
    table.done(p, q)
    found.push(p, q)
  }
  const ends = rows(packed, found)
  return { ends, places: null, room: roomOf(packed, ends), area: ends.length > 0 ? areaOf(packed, triangles) : 0 }
}

/** Area of a surface, in steps of the grid. */
export function areaOf(packed: Uint16Array, triangles: Uint32Array): number {
  const area = new Facet(packed)
  let sum = 0
  for (let t = 0; t < triangles.length; t += 3) sum += area.of(triangles, t)
  return sum
}

/** Without the short rows of edges that have an end. */
function rows(packed: Uint16Array, found: number[]): Uint32Array {
  const count = packed.length / 4
  const up = new Uint32Array(found.length > 0 ? count : 0)
  for (let v = 0; v < up.length; v++) up[v] = v
  const root = (v: number): number => {
    while (up[v] !== v) v = up[v] = up[up[v]]
    return v
  }
  const meeting = new Uint8Array(up.length)
  for (const v of found) meeting[v] = Math.min(2, meeting[v] + 1)
  for (let i = 0; i < found.length; i += 2) up[root(found[i])] = root(found[i + 1])
  // Of each row by its root: how long, and whether it has an end.
  const lengths = new Float64Array(up.length)
  const open = new Uint8Array(up.length)
  for (let i = 0; i < found.length; i += 2) {
    const [a, b] = [found[i], found[i + 1]]
    const [p, q, r] = [4 * a, 4 * b, root(a)]
    lengths[r] += Math.sqrt((packed[p] - packed[q]) ** 2 + (packed[p + 1] - packed[q + 1]) ** 2 + (packed[p + 2] - packed[q + 2]) ** 2)
    if (meeting[a] === 1 || meeting[b] === 1) open[r] = 1
  }
  const kept = (v: number) => open[root(v)] === 0 || lengths[root(v)] > SHORT
  return Uint32Array.from(found.filter(kept))
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
    let slot = mixed(packed[p] | (packed[p + 1] << 16), packed[p + 2]) & (size - 1)
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
    let slot = mixed(low, high) & (this.size - 1)
    while (this.slots[slot] !== -1 && (this.keys[2 * slot] !== low || this.keys[2 * slot + 1] !== high)) slot = (slot + 1) & (this.size - 1)
    this.keys[2 * slot] = low
    this.keys[2 * slot + 1] = high
    return slot
  }
}

/** Area and direction of a facet, in steps of the grid. */
class Facet {
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
    const across = (ux - vx) ** 2 + (uy - vy) ** 2 + (uz - vz) ** 2
    this.longest = Math.sqrt(Math.max(ux * ux + uy * uy + uz * uz, vx * vx + vy * vy + vz * vz, across))
    return 0.5 * Math.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2)
  }
}

/** Whether the facets of two corners, which have the edge that begins at each, surely meet at more than the angle. */
function sharp(packed: Uint16Array, triangles: Uint32Array, place: Uint32Array, g: number, h: number): boolean {
  // One lies on the other.
  if (place[triangles[next(next(g))]] === place[triangles[next(next(h))]]) return false
  const [one, two] = [new Facet(packed), new Facet(packed)]
  const [a, b] = [one.of(triangles, g - (g % 3)), two.of(triangles, h - (h % 3))]
  if (a === 0 || b === 0) return false
  // Facets of one orientation run along their edge in opposite ways.
  const along = place[triangles[g]] === place[triangles[h]] ? -1 : 1
  const [[ax, ay, az], [bx, by, bz]] = [one.normal, two.normal]
  const cosine = (along * (ax * bx + ay * by + az * bz)) / (4 * a * b)
  // A facet lower than that may have been turned over.
  const tilt = (area: number, longest: number) => {
    const height = (2 * area) / longest
    return height > ROUNDING ? Math.atan(ROUNDING / height) : Math.PI
  }
  return Math.acos(Math.min(1, Math.max(-1, cosine))) > CREASE + tilt(a, one.longest) + tilt(b, two.longest)
}
