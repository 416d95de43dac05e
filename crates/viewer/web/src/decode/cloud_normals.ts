import { mixed } from './hash'
import { NO_NORMAL, octahedral } from './normals'

/** Points that a cell should hold, on average. Its normal is that of the points in it and in the cells around it. */
const WANTED = 8
/** Cells along the longest side by which the area is measured first. */
const TRIAL = 128
/** Around a place where the points are thicker than this share of how wide they are, there is no surface. */
const THICK = 0.4
/** Count, sums and sums of products of the places in a cell. */
const MOMENTS = 10

/**
 * Gives each point of a cloud the normal of the plane through its surroundings, without a sign, packed as that of a vertex: the
 * direction in which the points around it are spread least. Where they are spread alike there is none. Cost: linear.
 */
export function packCloudNormals(packed: Uint16Array): void {
  const count = packed.length / 4
  if (count < WANTED) return
  const trial = 65536 / TRIAL
  const occupied = new Cells(packed, trial).count
  // Points in a cell grow with its area.
  const size = Math.max(1, trial * Math.sqrt((WANTED * occupied) / count))
  const cells = new Cells(packed, size)
  const normals = cells.normals()
  for (let v = 0; v < count; v++) packed[4 * v + 3] = normals[cells.of[v]]
}

/** Points sorted into cubes. */
class Cells {
  count = 0
  /** The cell of each point. */
  readonly of: Uint32Array
  private readonly slots: Int32Array
  private readonly keys: Int32Array
  private sums = new Float64Array(0)

  constructor(
    packed: Uint16Array,
    size: number,
  ) {
    const points = packed.length / 4
    this.of = new Uint32Array(points)
    this.slots = new Int32Array(2 ** Math.ceil(Math.log2(2 * points + 2))).fill(-1)
    this.keys = new Int32Array(3 * points)
    const scale = 1 / size
    for (let v = 0, p = 0; v < points; v++, p += 4) {
      const [i, j, k] = [Math.floor(packed[p] * scale), Math.floor(packed[p + 1] * scale), Math.floor(packed[p + 2] * scale)]
      const slot = this.slotOf(i, j, k)
      if (this.slots[slot] < 0) {
        this.keys.set([i, j, k], 3 * this.count)
        this.slots[slot] = this.count++
      }
      this.of[v] = this.slots[slot]
    }
    this.sums = new Float64Array(MOMENTS * this.count)
    for (let v = 0, p = 0; v < points; v++, p += 4) {
      const [x, y, z, at] = [packed[p], packed[p + 1], packed[p + 2], MOMENTS * this.of[v]]
      const { sums } = this
      sums[at] += 1
      sums[at + 1] += x
      sums[at + 2] += y
      sums[at + 3] += z
      sums[at + 4] += x * x
      sums[at + 5] += y * y
      sums[at + 6] += z * z
      sums[at + 7] += x * y
      sums[at + 8] += y * z
      sums[at + 9] += z * x
    }
  }

  /** The slot of a cell, or the free one where it belongs. */
  private slotOf(i: number, j: number, k: number): number {
    const mask = this.slots.length - 1
    let slot = mixed(i | (j << 16), k) & mask
    for (; this.slots[slot] >= 0; slot = (slot + 1) & mask) {
      const at = 3 * this.slots[slot]
      if (this.keys[at] === i && this.keys[at + 1] === j && this.keys[at + 2] === k) break
    }
    return slot
  }

  /** The packed normal of each cell. */
  normals(): Uint16Array {
    const out = new Uint16Array(this.count)
    const sum = new Float64Array(MOMENTS)
    for (let cell = 0; cell < this.count; cell++) {
      const [i, j, k] = [this.keys[3 * cell], this.keys[3 * cell + 1], this.keys[3 * cell + 2]]
      sum.fill(0)
      for (let n = 0; n < 27; n++) {
        const near = this.slots[this.slotOf(i + (n % 3) - 1, j + (Math.floor(n / 3) % 3) - 1, k + Math.floor(n / 9) - 1)]
        if (near >= 0) for (let m = 0; m < MOMENTS; m++) sum[m] += this.sums[MOMENTS * near + m]
      }
      out[cell] = normalOf(sum)
    }
    return out
  }
}

/** The direction of least spread of places with these moments. */
function normalOf([n, x, y, z, xx, yy, zz, xy, yz, zx]: Float64Array): number {
  if (n < 3) return NO_NORMAL
  const a = xx / n - (x / n) ** 2
  const b = yy / n - (y / n) ** 2
  const c = zz / n - (z / n) ** 2
  const d = xy / n - (x * y) / n ** 2
  const e = yz / n - (y * z) / n ** 2
  const f = zx / n - (z * x) / n ** 2
  const [least, middle] = spreads(a, b, c, d, e, f)
  if (!(middle > 0) || least > THICK * middle) return NO_NORMAL
  // The normal is at right angles to the rows of the matrix less its least eigenvalue: the longest product of two of them.
  const rows = [[a - least, d, f], [d, b - least, e], [f, e, c - least]]
  let best = [0, 0, 0]
  let longest = 0
  for (const [p, q] of [[rows[0], rows[1]], [rows[1], rows[2]], [rows[2], rows[0]]]) {
    const product = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
    const length = product[0] ** 2 + product[1] ** 2 + product[2] ** 2
    if (length > longest) [best, longest] = [product, length]
  }
  return octahedral(best[0], best[1], best[2])
}

/** The least and the middle eigenvalue of a symmetric matrix with this diagonal and these numbers beside it (Smith, 1961). */
function spreads(a: number, b: number, c: number, d: number, e: number, f: number): [number, number] {
  const mean = (a + b + c) / 3
  const beside = d * d + e * e + f * f
  const [p, q, r] = [a - mean, b - mean, c - mean]
  const size = Math.sqrt((p * p + q * q + r * r + 2 * beside) / 6)
  if (size === 0) return [mean, mean]
  const half = (p * (q * r - e * e) - d * (d * r - e * f) + f * (d * e - q * f)) / (2 * size ** 3)
  const angle = Math.acos(Math.min(1, Math.max(-1, half))) / 3
  const most = mean + 2 * size * Math.cos(angle)
  const least = mean + 2 * size * Math.cos(angle + (2 * Math.PI) / 3)
  return [least, 3 * mean - most - least]
}
