import type { Vector3 } from 'three'
import type { Eye } from './eye'
import type { Cover, Part } from './part'
import { OBLIQUE } from './shaders'
import type { ValueBuffer } from './values'

/** How far before a place something may lie without hiding it: pixels, and share of the view's height. */
const PIXELS = 6
const SHARE = 0.01
/** Share of the size of everything that a place of a cloud may lie under its surface. */
export const NEAR = 0.002

/**
 * Whether something lies before a place. Where the values of the picture are read it is a look-up; until then, and while
 * the picture moves, the place is held against the coarsest level of what is shown, so that an answer is always there.
 *
 * Between the points of a cloud one looks through, and the part is there all the same. There the place is held against the
 * reference's surface, shown or not, else against the points as discs that close it; the view's size makes no difference.
 */
export class Sight {
  private from: { key: string; covers: Seen[] } | null = null

  constructor(
    private readonly eye: Eye,
    private readonly values: ValueBuffer,
    private readonly shown: () => Part[],
    /** Surfaces that stand for the clouds that are shown; `null` where none is. */
    private readonly surfaces: () => Part[] | null,
  ) {}

  /** `slack`: how far the place may lie under the surface, millimeters. */
  hidden(place: Vector3, slack: number): boolean {
    const { eye, values } = this
    const p = eye.project(place)
    const surfaces = this.surfaces()
    if (surfaces) {
      const near = p.depth + Math.max(NEAR * eye.size, slack)
      return this.covers(surfaces).some((cover) => covered(cover, p, near + cover.margin))
    }
    const before = p.depth + Math.max(PIXELS * eye.millimetresPerPixel, SHARE * eye.height, slack)
    if (!values.ready) return this.covers(this.shown()).some((cover) => covered(cover, p, before))
    const near = [-1, 0, 1].flatMap((i) => [-1, 0, 1].map((j) => values.at(p.x + i, p.y + j)))
    const seen = near.filter((r) => r !== null)
    return seen.length > 0 && seen.every((r) => r.depth > before)
  }

  /** Parts in pixels and depths of this view. */
  private covers(all: Part[]): Seen[] {
    const parts = all.filter((p) => !p.translucent)
    const key = [...this.eye.save(), this.eye.width, this.eye.pixels, this.eye.perspective, ...parts.map((p) => p.object.id)].join()
    if (this.from?.key !== key) this.from = { key, covers: parts.map((p) => seenFrom(this.eye, p.cover())) }
    return this.from.covers
  }
}

/** A cover as the eye sees it: x, y and depth of each place. */
interface Seen {
  at: Float32Array
  corners: Uint32Array
  /** Radius of a point, pixels. */
  radius: number
  /** How far before a place it may lie without hiding it, millimeters. */
  margin: number
}

function seenFrom(eye: Eye, { places, corners, radius, error }: Cover): Seen {
  const at = new Float32Array(places.length)
  const camera = eye.camera
  const m = camera.matrixWorldInverse.elements
  const [half, middle, foot] = [eye.pixels / eye.height, eye.width / 2, eye.pixels / 2]
  for (let p = 0; p < places.length; p += 3) {
    const [x, y, z] = [places[p], places[p + 1], places[p + 2]]
    const depth = m[2] * x + m[6] * y + m[10] * z + m[14]
    const scale = eye.growth(depth) * half
    at[p] = middle + scale * (m[0] * x + m[4] * y + m[8] * z + m[12])
    at[p + 1] = foot - scale * (m[1] * x + m[5] * y + m[9] * z + m[13])
    at[p + 2] = depth
  }
  return { at, corners, radius: radius / eye.millimetresPerPixel, margin: OBLIQUE * radius + 2 * error }
}

/** Something of it lies at the pixel of `p` and nearer to the eye than the depth `before`. */
function covered({ at, corners, radius }: Seen, p: { x: number; y: number }, before: number): boolean {
  const { x, y } = p
  if (corners.length === 0) {
    for (let i = 0; i < at.length; i += 3) if (at[i + 2] > before && (at[i] - x) ** 2 + (at[i + 1] - y) ** 2 < radius * radius) return true
    return false
  }
  for (let t = 0; t < corners.length; t += 3) {
    const [a, b, c] = [3 * corners[t], 3 * corners[t + 1], 3 * corners[t + 2]]
    const [ax, bx, cx] = [at[a] - x, at[b] - x, at[c] - x]
    if ((ax < 0 && bx < 0 && cx < 0) || (ax > 0 && bx > 0 && cx > 0)) continue
    const [ay, by, cy] = [at[a + 1] - y, at[b + 1] - y, at[c + 1] - y]
    // Twice the areas opposite the corners: all of one sign where the pixel is inside.
    const [u, v, w] = [bx * cy - by * cx, cx * ay - cy * ax, ax * by - ay * bx]
    if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))) continue
    const area = u + v + w
    if (area !== 0 && (u * at[a + 2] + v * at[b + 2] + w * at[c + 2]) / area > before) return true
  }
  return false
}
