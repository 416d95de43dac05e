import { BufferAttribute, BufferGeometry, Matrix4, Mesh, Points, Vector3, type Texture } from 'three'
import { NO_VALUE, type DecodedObject } from '../decode/object'
import type { ViewObject } from '../manifest'
import { EdgeLines } from './edges'
import type { Eye } from './eye'
import { materialsFor, type Materials } from './look'

/** What can hide a place: the places of a coarse level, relative to the stage's center, and its triangles or its points' size. */
export interface Cover {
  places: Float32Array
  corners: Uint32Array
  /** Radius of a point, millimeters. */
  radius: number
  /** How far the level may lie from what it stands for, millimeters. */
  error: number
}

/**
 * Pixels that objects of a role are drawn farther from the eye than they are: a surface shown together with one it agrees
 * with lies behind that, wherever both are the same within a pixel, instead of through it.
 */
const SINKING: Record<string, number> = { reference: 1.5, before: 1.5, surface: 1.5 }

/** Points that stand for a cloud which hides something. */
const COVER_POINTS = 60_000
/** Points whose neighbors tell how far apart a cloud's points lie, and the neighbor that is as far as that. */
const PROBES = 32
const NEIGHBOR = 4
/** Discs of points, in spacings: of this diameter they close the surface but for a few gaps where points lie at random. */
const CLOSED = 2
/** And of this one they close it but for a thousandth. */
const OPAQUE = 3
/** Pixels of a disc: least, most, and most where the points are fewer than make a surface. */
const DISC = { least: 2, most: 64, single: 24, few: 2000 }

/** An object on the stage: its buffers on the GPU, its levels of detail, its values. */
export class Part {
  readonly drawn: Mesh | Points
  readonly materials: Materials
  /** Its sharp edges, where it is a surface with some that is not looked through. */
  readonly edges: EdgeLines | null
  /** First element and count of each level: the full one first for meshes, the coarsest first for points. */
  private readonly levels: { start: number; count: number }[]
  private field = -2
  private covering: Cover | null = null
  private measured: number | null = null

  constructor(
    readonly object: ViewObject,
    private readonly data: DecodedObject,
    center: Vector3,
  ) {
    const geometry = new BufferGeometry()
    geometry.setAttribute('position', new BufferAttribute(data.packed, 4))
    if (data.faces) geometry.setAttribute('face', new BufferAttribute(data.faces, 1))
    if (object.kind === 'mesh') geometry.setIndex(new BufferAttribute(data.corners, 1))
    this.materials = materialsFor(object)
    this.drawn = object.kind === 'mesh' ? new Mesh(geometry, this.materials.picture) : new Points(geometry, this.materials.picture)
    this.drawn.frustumCulled = false
    this.drawn.matrixAutoUpdate = false
    const [x, y, z] = object.origin
    this.drawn.matrix = new Matrix4().makeScale(object.step, object.step, object.step)
    // The difference is taken in double precision: no world coordinate ever becomes a float.
    this.drawn.matrix.setPosition(x - center.x, y - center.y, z - center.z)
    this.drawn.matrixWorldNeedsUpdate = true
    const sharp = data.edges && data.edges.ends.length > 0 && !this.translucent ? data.edges : null
    this.edges = sharp && new EdgeLines(sharp, data.packed, this.drawn.matrix, object.step)
    this.levels = levelsOf(object)
    this.showField(0)
    this.setLevel(0)
  }

  /** Shows the deviations of one comparison; the plain body where this object has none. */
  showField(comparison: number): void {
    const index = this.object.fields.findIndex((f) => f.comparison === comparison)
    if (index === this.field) return
    this.field = index
    const values = this.data.fields[index] ?? new Float32Array(this.object.vertices)
    this.drawn.geometry.setAttribute('value', new BufferAttribute(values, 1))
    this.materials.own.slack.value = 0.5001 * (this.object.fields[index]?.step ?? 0)
  }

  setMap(on: boolean): void {
    this.materials.own.map.value = on && this.field >= 0
  }

  /** Drawn behind what lies in one surface with it. */
  get sinks(): boolean {
    return this.object.role in SINKING
  }

  /** What depends on the eye: what lies in one surface with the part is drawn before or behind it by pixels. `others`: a surface that
   *  does not sink shows its edges; two that hardly differ would be one dark edge. */
  setEye(eye: Eye, ratio: number, others: boolean): void {
    const sunk = eye.millimetresPerPixel * (SINKING[this.object.role] ?? 0)
    this.materials.own.sink.value = sunk
    this.edges?.update(eye, ratio, sunk, this.sinks && others)
  }

  /** Steps back to gray while another object is meant. */
  setBack(back: boolean): void {
    this.materials.own.back.value = back
  }

  /** One looks through it. */
  get translucent(): boolean {
    return this.materials.picture.transparent
  }

  get hasMap(): boolean {
    return this.field >= 0
  }

  get levelCount(): number {
    return this.levels.length
  }

  /** 0 is everything, greater numbers are coarser. */
  setLevel(level: number): void {
    const { start, count } = this.levels[Math.min(level, this.levels.length - 1)]
    this.drawn.geometry.setDrawRange(start, count)
    this.edges?.show(this.drawn.visible, level > 0)
  }

  /** Why there is no value, by the number that the value buffer gives. */
  reason(number: number): string {
    const field = this.object.fields[this.field]
    const lowest = -(2 ** ((field?.bits ?? 16) - 1))
    return field?.no_value[String(lowest + number - 1)] ?? 'excluded'
  }

  /** Half a step: what a value read off the picture can be wrong by, beside interpolation. */
  get step(): number {
    return this.object.fields[this.field]?.step ?? 0
  }

  /**
   * Where places show gathered points: the value of the vertex nearest to a place, which is a measured point's and no mixture.
   * Elsewhere nothing. Looks at all vertices.
   */
  pointNear(place: Vector3): number | null {
    const values = this.data.fields[this.field]
    if (!this.object.reach || !values) return null
    const { origin, step } = this.object
    const [x, y, z] = [0, 1, 2].map((k) => (place.getComponent(k) - origin[k]) / step)
    const { packed } = this.data
    let best: number | null = null
    let least = Infinity
    for (let v = 0, p = 0; p < packed.length; v++, p += 4) {
      const d = (packed[p] - x) ** 2 + (packed[p + 1] - y) ** 2 + (packed[p + 2] - z) ** 2
      if (d < least && values[v] < NO_VALUE / 2) {
        least = d
        best = values[v]
      }
    }
    return best
  }

  /** Corners of the box around all vertices, relative to the stage's center. */
  corners(): Vector3[] {
    const low = [65535, 65535, 65535]
    const high = [0, 0, 0]
    const { packed } = this.data
    for (let p = 0; p < packed.length; p += 4)
      for (let k = 0; k < 3; k++) {
        const x = packed[p + k]
        if (x < low[k]) low[k] = x
        if (x > high[k]) high[k] = x
      }
    if (packed.length === 0) return []
    const corner = (i: number) => new Vector3(...[0, 1, 2].map((k) => ((i >> k) & 1 ? high[k] : low[k])))
    return Array.from({ length: 8 }, (_, i) => corner(i).applyMatrix4(this.drawn.matrix))
  }

  /** The coarsest level as what hides other places; made when first asked for. */
  cover(): Cover {
    return (this.covering ??= this.object.kind === 'mesh' ? this.coverOfMesh() : this.coverOfPoints())
  }

  private coverOfMesh(): Cover {
    const { start, count } = this.levels[this.levels.length - 1]
    const numbers = new Map<number, number>()
    const corners = this.data.corners.slice(start, start + count).map((v) => {
      if (!numbers.has(v)) numbers.set(v, numbers.size)
      return numbers.get(v) ?? 0
    })
    return { places: this.placesOf([...numbers.keys()]), corners, radius: 0, error: this.object.levels.at(-1)?.error ?? 0 }
  }

  /** Points are stored so that every prefix is an even sample. */
  private coverOfPoints(): Cover {
    const count = Math.min(COVER_POINTS, this.object.vertices)
    return { places: this.placesOf(Array.from({ length: count }, (_, v) => v)), corners: new Uint32Array(0), radius: (OPAQUE / 2) * this.spacing(count), error: 0 }
  }

  private placesOf(vertices: number[]): Float32Array {
    const places = new Float32Array(3 * vertices.length)
    const place = new Vector3()
    vertices.forEach((v, i) => {
      place.fromArray(this.data.packed, 4 * v).applyMatrix4(this.drawn.matrix).toArray(places, 3 * i)
    })
    return places
  }

  /** Sets the size of points: as large as closes the surface they lie on, and with `opaque` to the last gap. */
  setPoints(millimetresPerPixel: number, ratio: number, opaque = false): void {
    if (this.object.kind !== 'points') return
    const spacing = this.spacing(this.drawn.geometry.drawRange.count)
    const most = this.object.vertices < DISC.few ? DISC.single : DISC.most
    const wanted = ((opaque ? OPAQUE : CLOSED) * spacing) / millimetresPerPixel
    const size = opaque ? wanted : Math.min(most, Math.max(DISC.least, wanted))
    const { own } = this.materials
    own.pointSize.value = ratio * size
    const radius = (size / 2) * millimetresPerPixel
    own.lift.value = opaque ? 0 : Math.min(spacing, radius)
    own.rise.value = opaque ? 0 : radius
  }

  /** How far behind its nearest place a surface of discs may have points of its own, millimeters. */
  get depth(): number {
    return this.object.kind === 'points' ? OPAQUE * this.spacing(this.object.vertices) : 0
  }

  /** Points behind the surface in `cover` have no values; those within `near` of it, and those as far off as they measure, lie on it. */
  setCover(cover: Texture | null, near: number): void {
    const { own } = this.materials
    own.cover.value = cover
    own.covered.value = cover !== null
    own.near.value = near
  }

  /** How far apart the points lie where only the first `count` are drawn, an even sample: millimeters. */
  spacing(count: number): number {
    return this.apart * Math.sqrt(this.object.vertices / Math.max(1, Math.min(count, this.object.vertices)))
  }

  /**
   * How far apart all points lie: the median distance of some of them from their fourth neighbor, which is the same on a
   * grid and where they lie at random. Made when first asked for.
   */
  private get apart(): number {
    if (this.measured !== null) return this.measured
    const { packed } = this.data
    const count = packed.length / 4
    const found: number[] = []
    for (let probe = 0; probe < Math.min(PROBES, count); probe++) {
      const v = 4 * Math.floor((probe * count) / Math.min(PROBES, count))
      // The place itself is among them.
      const least = new Float64Array(NEIGHBOR + 1).fill(Infinity)
      const [x, y, z] = [packed[v], packed[v + 1], packed[v + 2]]
      for (let p = 0; p < packed.length; p += 4) {
        // One product tells most of them.
        const along = (packed[p] - x) ** 2
        if (along >= least[NEIGHBOR]) continue
        const d = along + (packed[p + 1] - y) ** 2 + (packed[p + 2] - z) ** 2
        if (d >= least[NEIGHBOR]) continue
        let i = NEIGHBOR
        for (; i > 0 && least[i - 1] > d; i--) least[i] = least[i - 1]
        least[i] = d
      }
      if (least[NEIGHBOR] < Infinity) found.push(Math.sqrt(least[NEIGHBOR]))
    }
    found.sort((a, b) => a - b)
    return (this.measured = (found[found.length >> 1] ?? 65535) * this.object.step)
  }

  /** Up to `n` evenly chosen vertices, relative to the stage's center: enough to frame the part. */
  sample(n: number): Vector3[] {
    const { packed } = this.data
    const stride = 4 * Math.max(1, Math.floor(packed.length / 4 / n))
    const out: Vector3[] = []
    for (let p = 0; p < packed.length; p += stride)
      out.push(new Vector3(packed[p], packed[p + 1], packed[p + 2]).applyMatrix4(this.drawn.matrix))
    return out
  }
}

function levelsOf(object: ViewObject): { start: number; count: number }[] {
  if (object.kind === 'points') {
    const counts = object.levels.map((l) => l.points ?? 0).reverse()
    return (counts.length ? counts : [object.vertices]).map((count) => ({ start: 0, count }))
  }
  let start = 0
  return [object.triangles ?? 0, ...object.levels.map((l) => l.triangles ?? 0)].map((triangles) => {
    const level = { start, count: 3 * triangles }
    start += 3 * triangles
    return level
  })
}
