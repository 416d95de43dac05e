import { AlwaysDepth, BufferAttribute, BufferGeometry, GLSL3, GreaterDepth, Group, InstancedBufferAttribute, InstancedBufferGeometry, LessEqualDepth, Mesh, RawShaderMaterial, Vector2, Vector3, type IUniform } from 'three'
import type { DecodedObject } from '../decode/object'
import type { MarksObject } from '../manifest'
import { parse } from '../scale/scale'
import type { Eye } from './eye'
import { MARK_AREA, MARK_AREA_VERTEX, MARK_LINE, MARK_LINE_VERTEX } from './mark_shaders'

/** Pixels across. */
const LINE = 3.2
const DOT = 9
/** Marks are drawn this many pixels nearer than they are, so that they lie on the surface and not in it. */
const LIFT = 3
/** How much shows of what the part hides. */
const BEHIND = 0.38

/**
 * Areas, lines and dots over the part: drawn pale where something hides them, then in full where nothing does, then what is
 * chosen over all.
 */
export class Marks {
  readonly drawn = new Group()
  /** Three numbers each, relative to the stage's center. */
  private readonly places: Float32Array
  private readonly shared: Record<'viewport' | 'ratio' | 'lift' | 'selected' | 'pulse', IUniform> = {
    viewport: { value: new Vector2() },
    ratio: { value: 1 },
    lift: { value: 0 },
    selected: { value: -1 },
    pulse: { value: 0 },
  }

  constructor(
    readonly object: MarksObject,
    data: DecodedObject,
    center: Vector3,
  ) {
    const { triangles, segments, points, first } = object
    const places = placesOf(object, data, center)
    this.places = places
    const numbers = data.corners
    const tints = tintsOf(object, numbers)
    const areas = areaGeometry(places.subarray(0, 9 * triangles), numbers, tints, first)
    const lines = lineGeometry(places.subarray(9 * triangles), numbers, tints.subarray(3 * triangles), object)
    const passes = [
      { depthFunc: GreaterDepth, opacity: BEHIND, chosen: false },
      { depthFunc: LessEqualDepth, opacity: 1, chosen: false },
      { depthFunc: AlwaysDepth, opacity: 1, chosen: true },
    ] as const
    for (const pass of passes) {
      // Edges of the part itself are hidden by it.
      if (pass.depthFunc === GreaterDepth && ['edges', 'iso_lines', 'reflection_lines'].includes(object.role)) continue
      if (triangles > 0) this.add(areas, MARK_AREA_VERTEX, MARK_AREA, pass, 0.8)
      if (segments + points > 0) this.add(lines, MARK_LINE_VERTEX, MARK_LINE, pass, 1)
    }
  }

  private add(geometry: BufferGeometry, vertexShader: string, fragmentShader: string, pass: Pass, most: number): void {
    const { depthFunc, chosen } = pass
    const uniforms = { ...this.shared, opacity: { value: most * pass.opacity }, only: { value: chosen } }
    const look = { glslVersion: GLSL3, vertexShader, fragmentShader, uniforms, side: 2, depthFunc, depthWrite: false, transparent: true } as const
    const mesh = new Mesh(geometry, new RawShaderMaterial(look))
    mesh.frustumCulled = false
    this.drawn.add(mesh)
  }

  /** Up to `n` evenly chosen places: enough to frame them. */
  sample(n: number): Vector3[] {
    const stride = 3 * Math.max(1, Math.floor(this.places.length / 3 / n))
    const out: Vector3[] = []
    for (let p = 0; p < this.places.length; p += stride) out.push(new Vector3().fromArray(this.places, p))
    return out
  }

  /** Whether the mark with this number over all marks is one of these. */
  has(mark: number): boolean {
    const { first, groups } = this.object
    return mark >= first && mark < first + groups.reduce((n, group) => n + group.count, 0)
  }

  /** Highlights a mark by its number over all marks; none at −1. */
  select(mark: number): void {
    this.shared.selected.value = mark
  }

  /** 1 at the height of a flash, 0 at rest. */
  flash(pulse: number): void {
    this.shared.pulse.value = pulse
  }

  /** What depends on the eye. */
  update(eye: Eye, ratio: number): void {
    this.shared.viewport.value.set(eye.width * ratio, eye.pixels * ratio)
    this.shared.ratio.value = ratio
    this.shared.lift.value = LIFT * eye.millimetresPerPixel
  }
}

interface Pass {
  depthFunc: typeof GreaterDepth | typeof LessEqualDepth | typeof AlwaysDepth
  opacity: number
  /** Only what is chosen. */
  chosen: boolean
}

/** Places relative to the stage's center, three numbers each. */
function placesOf(object: MarksObject, data: DecodedObject, center: Vector3): Float32Array {
  const out = new Float32Array(3 * object.vertices)
  for (let v = 0; v < object.vertices; v++)
    for (let k = 0; k < 3; k++) out[3 * v + k] = object.origin[k] - center.getComponent(k) + object.step * data.packed[4 * v + k]
  return out
}

/** A color for each area, line and dot: that of its group. */
function tintsOf(object: MarksObject, numbers: Uint32Array): Uint8Array {
  const colors = object.groups.flatMap((g) => Array<number[]>(g.count).fill(parse(g.color)[0]))
  const out = new Uint8Array(3 * numbers.length)
  numbers.forEach((n, i) => out.set(colors[n] ?? [0, 0, 0], 3 * i))
  return out
}

function areaGeometry(places: Float32Array, numbers: Uint32Array, tints: Uint8Array, first: number): BufferGeometry {
  const vertices = places.length / 3
  const [mark, tint] = [new Float32Array(vertices), new Uint8Array(3 * vertices)]
  for (let v = 0; v < vertices; v++) {
    const t = Math.floor(v / 3)
    mark[v] = first + numbers[t]
    tint.set(tints.subarray(3 * t, 3 * t + 3), 3 * v)
  }
  const geometry = new BufferGeometry()
  geometry.setAttribute('position', new BufferAttribute(places, 3))
  geometry.setAttribute('tint', new BufferAttribute(tint, 3, true))
  geometry.setAttribute('mark', new BufferAttribute(mark, 1))
  return geometry
}

/**
 * A line is a strip with round ends as wide as it is on the screen; a dot is a short and wide one. First the rims of
 * areas are drawn, then dots, then lines: a dot is wider, and is seen on both sides of the line that lies over it.
 */
function lineGeometry(places: Float32Array, numbers: Uint32Array, tints: Uint8Array, { triangles, segments, points, first }: MarksObject): BufferGeometry {
  const count = segments + points
  const areas = new Set(numbers.subarray(0, triangles))
  numbers = numbers.subarray(triangles)
  const layer = (i: number) => (i >= segments ? 1 : areas.has(numbers[i]) ? 0 : 2)
  const starts = [0, 0, 0]
  for (let i = 0; i < count; i++) for (let k = layer(i) + 1; k < 3; k++) starts[k]++
  const [a, b, wide, mark] = [new Float32Array(3 * count), new Float32Array(3 * count), new Float32Array(count), new Float32Array(count)]
  const tint = new Uint8Array(3 * count)
  for (let i = 0; i < count; i++) {
    const line = i < segments
    const from = line ? 6 * i : 6 * segments + 3 * (i - segments)
    const at = starts[layer(i)]++
    a.set(places.subarray(from, from + 3), 3 * at)
    b.set(places.subarray(line ? from + 3 : from, line ? from + 6 : from + 3), 3 * at)
    tint.set(tints.subarray(3 * i, 3 * i + 3), 3 * at)
    wide[at] = line ? LINE : DOT
    mark[at] = first + numbers[i]
  }
  const geometry = new InstancedBufferGeometry()
  geometry.setAttribute('corner', new BufferAttribute(new Float32Array([0, -1, 1, -1, 1, 1, 0, 1]), 2))
  geometry.setIndex([0, 1, 2, 0, 2, 3])
  geometry.setAttribute('a', new InstancedBufferAttribute(a, 3))
  geometry.setAttribute('b', new InstancedBufferAttribute(b, 3))
  geometry.setAttribute('tint', new InstancedBufferAttribute(tint, 3, true))
  geometry.setAttribute('wide', new InstancedBufferAttribute(wide, 1))
  geometry.setAttribute('mark', new InstancedBufferAttribute(mark, 1))
  geometry.instanceCount = count
  return geometry
}
