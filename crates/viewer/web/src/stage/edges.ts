import { BufferAttribute, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry, Matrix4, Mesh, RawShaderMaterial, Vector2 } from 'three'
import type { SharpEdges } from '../decode/edges'
import { Crowd } from './crowd'
import type { Eye } from './eye'
import { EDGE, EDGE_VERTEX } from './mark_shaders'

/** Pixels across. */
const WIDE = 1.3
/** Pixels that edges are drawn nearer than they are, so that they lie on the facets and not between them. */
const LIFT = 2
/** How much of what lies under an edge it covers. */
const OPACITY = 0.75
/** Edges may cover this share of the surface; where they lie denser than that they step back, for the colors' sake. */
const SHARE = 0.1
/** And this share of the surface around them: where they crowd, each of them steps back by the square of what is beyond. */
const CROWD = 0.5
/** Fainter than this they are left out. */
const FAINTEST = 0.15
/** More than these are not drawn while the picture moves and its triangles are fewer. */
const QUICK = 20_000

/** The sharp edges of a surface, drawn as lines: without them faces of one color run into each other. */
export class EdgeLines {
  readonly drawn: Mesh
  private readonly uniforms = { viewport: { value: new Vector2() }, wide: { value: 1 }, lift: { value: 0 }, opacity: { value: OPACITY }, needed: { value: 0 } }
  private readonly crowd: Crowd
  /** Of the surface, in steps of the grid. */
  private readonly area: number
  private readonly count: number
  private asked = true
  private coarse = false
  private faint = false
  private under = false

  /** `packed`: four numbers a vertex of the surface; `matrix` leads from its grid to the stage, with `step` millimeters a step. */
  constructor(edges: SharpEdges, packed: Uint16Array, matrix: Matrix4, private readonly step: number) {
    this.count = edges.ends.length / 2
    this.area = edges.area
    const ends = [new Uint16Array(3 * this.count), new Uint16Array(3 * this.count)]
    const places = edges.places ?? packed
    edges.ends.forEach((v, i) => ends[i % 2].set(places.subarray(4 * v, 4 * v + 3), 3 * (i >> 1)))
    const lengths = new Float32Array(this.count)
    for (let i = 0, e = 0; i < this.count; i++, e += 3)
      lengths[i] = Math.sqrt([0, 1, 2].reduce((sum, k) => sum + (ends[0][e + k] - ends[1][e + k]) ** 2, 0))
    this.crowd = new Crowd(edges.room, lengths)
    const geometry = new InstancedBufferGeometry()
    geometry.setAttribute('corner', new BufferAttribute(new Float32Array([0, -1, 1, -1, 1, 1, 0, 1]), 2))
    geometry.setIndex([0, 1, 2, 0, 2, 3])
    geometry.setAttribute('a', new InstancedBufferAttribute(ends[0], 3))
    geometry.setAttribute('b', new InstancedBufferAttribute(ends[1], 3))
    geometry.setAttribute('room', new InstancedBufferAttribute(edges.room, 1))
    geometry.instanceCount = this.count
    const look = { glslVersion: GLSL3, vertexShader: EDGE_VERTEX, fragmentShader: EDGE, side: 2, depthWrite: false, transparent: true } as const
    this.drawn = new Mesh(geometry, new RawShaderMaterial({ ...look, uniforms: this.uniforms }))
    this.drawn.frustumCulled = false
    this.drawn.matrixAutoUpdate = false
    this.drawn.matrix = matrix
    this.drawn.matrixWorldNeedsUpdate = true
  }

  /** Whether the surface is shown, and whether as fewer triangles than it has. */
  show(visible: boolean, coarse: boolean): void {
    this.asked = visible
    this.coarse = coarse
    this.apply()
  }

  /** What depends on the eye; the surface is drawn `sunk` millimeters farther away, `under` one with edges of its own. */
  update(eye: Eye, ratio: number, sunk: number, under: boolean): void {
    this.under = under
    const { viewport, wide, lift, opacity, needed } = this.uniforms
    viewport.value.set(eye.width * ratio, eye.pixels * ratio)
    wide.value = WIDE * ratio
    lift.value = LIFT * eye.millimetresPerPixel - sunk
    const across = (WIDE * eye.millimetresPerPixel) / this.step
    needed.value = across / CROWD
    const covered = this.area > 0 ? (across * this.crowd.seen(needed.value)) / this.area : Infinity
    opacity.value = OPACITY * Math.min(1, SHARE / covered)
    this.faint = opacity.value < FAINTEST
    this.apply()
  }

  private apply(): void {
    this.drawn.visible = this.asked && !this.faint && !this.under && !(this.coarse && this.count > QUICK)
  }
}
