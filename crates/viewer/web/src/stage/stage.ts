import { ColorManagement, LinearSRGBColorSpace, Scene, Vector3, WebGLRenderer } from 'three'
import { decodeAll } from '../decode/client'
import type { Pick } from '../manifest'
import type { State } from '../state'
import { Eye, type StandardView } from './eye'
import { applyLook } from './look'
import { Flight } from './flight'
import { Marks } from './marks'
import { Part } from './part'
import { ValueBuffer } from './values'

ColorManagement.enabled = false

/** After this long without movement the picture is drawn in full. */
const REST = 150
/** And after this long its values are read. */
const READ = 120
/** A frame while moving may take this long, milliseconds. */
const FRAME = 33
/** The closest view is this many steps of the drawing's grid high. */
const FINEST = 500
/** Room for the flags' columns where the stage is wide. */
const FLAGS = 150

/** The 3D stage: draws on demand only, never at rest. */
export class Stage {
  readonly renderer: WebGLRenderer
  readonly scene = new Scene()
  readonly eye: Eye
  readonly values: ValueBuffer
  readonly parts: Part[] = []
  readonly marks: Marks[] = []
  /** Middle of everything in the model's coordinates. */
  readonly center: Vector3
  private level = 0
  private moving = false
  private frame = 0
  private lastFrame = 0
  private restTimer = 0
  private readonly listeners: (() => void)[] = []
  private readonly flight = new Flight(() => this.flown())

  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly state: State,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: 'high-performance' })
    this.renderer.outputColorSpace = LinearSRGBColorSpace
    this.renderer.autoClear = false
    this.renderer.sortObjects = false
    this.values = new ValueBuffer(this.renderer)
    this.eye = new Eye(state.manifest.up)
    this.center = centerOf(state)
    const { facing } = state.manifest
    if (facing) this.eye.turn.copy(this.eye.showing(new Vector3(...facing)))
    this.scene.matrixAutoUpdate = false
    applyLook(state)
  }

  /** Decodes and shows all objects; the first view appears as soon as its objects are there. */
  async load(): Promise<void> {
    // What the first view shows comes first.
    const wanted = [...this.state.manifest.objects].sort((a, b) => Number(this.state.visible[b.role]) - Number(this.state.visible[a.role]))
    await decodeAll(wanted, (object, decoded) => {
      if (object.kind === 'marks') {
        const marks = new Marks(object, decoded, this.center)
        this.marks.push(marks)
        this.scene.add(marks.drawn)
        this.applyState()
        return this.fit()
      }
      const part = new Part(object, decoded, this.center)
      this.parts.push(part)
      this.scene.add(part.drawn)
      this.measure()
      this.applyState()
      if (part.drawn.visible) this.fit()
    })
  }

  private measure(): void {
    const corners = this.parts.flatMap((p) => p.corners())
    this.eye.setRadius(Math.max(1e-6, ...corners.map((c) => c.length())) * 1.01)
  }

  /** Called after every drawn frame. */
  onDraw(listener: () => void): void {
    this.listeners.push(listener)
  }

  /** Takes over what the reader changed, and draws. */
  applyState(): void {
    applyLook(this.state)
    this.eye.perspective = this.state.perspective
    const meant = this.state.manifest.picks[this.state.picked]?.object ?? null
    for (const part of this.parts) {
      const { role, comparison } = part.object
      part.showField(this.state.comparison)
      part.setMap(this.state.map)
      part.setBack(meant !== null && meant !== part.object.id)
      part.drawn.visible = this.state.visible[role] && (comparison === null || comparison === this.state.comparison)
    }
    const mark = this.state.manifest.picks[this.state.picked]?.mark ?? -1
    for (const marks of this.marks) {
      const { role, comparison } = marks.object
      marks.drawn.visible = this.state.visible[role] && (comparison === null || comparison === this.state.comparison)
      marks.select(mark)
      if (marks.has(mark)) this.scene.add(marks.drawn) // again, and so last: over the other marks
    }
    this.values.clear()
    this.draw()
    this.rest()
  }

  resize(width: number, height: number): void {
    const first = this.eye.pixels === 1
    this.eye.width = Math.max(1, width)
    this.eye.pixels = Math.max(1, height)
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio))
    // The canvas takes whole pixels, however the page's columns fall: else the picture is resampled and blurs.
    this.renderer.setSize(this.eye.width, this.eye.pixels, true)
    if (first) this.fit()
    this.values.clear()
    this.drawNow()
    this.rest()
  }

  get shown(): Part[] {
    return this.parts.filter((p) => p.drawn.visible)
  }

  part(object: number): Part | undefined {
    return this.parts.find((p) => p.object.id === object)
  }

  fit(): void {
    const flags = this.state.flags && this.state.picks.some(([, p]) => p.value !== null)
    const margin = flags && this.eye.width > 700 ? FLAGS : 0
    const marks = this.marks.filter((m) => m.drawn.visible)
    this.eye.fit([...this.shown.flatMap((p) => p.sample(20000)), ...marks.flatMap((m) => m.sample(2000))], margin)
    this.moved()
  }

  look(view: StandardView): void {
    this.eye.look(view)
    this.fit()
  }

  /** Brings a place of the list to the middle: near, where it has a size, and from the side that shows it. */
  flyTo(pick: Pick): void {
    const target = new Vector3(...pick.position.map((x, k) => x - this.center.getComponent(k)))
    const turn = pick.normal ? this.eye.showing(new Vector3(...pick.normal)) : this.eye.turn.clone()
    this.flight.start(this.eye, { turn, target, height: pick.reach === null ? this.eye.height : this.closeUp(pick.reach) })
  }

  /** Height of the view for something of half this size: six times it, within what the drawing can resolve and what fits. */
  private closeUp(reach: number): number {
    const step = Math.max(0, ...this.parts.map((p) => p.object.step))
    return Math.min(Math.max(12 * reach, FINEST * step), Math.max(this.eye.height, FINEST * step, 2 * reach))
  }

  private flown(): void {
    for (const marks of this.marks) marks.flash(this.flight.pulse)
    this.changed()
  }

  /** The eye has moved: draws the finest level that keeps up, and everything once it rests. */
  moved(): void {
    this.flight.stop()
    this.changed()
  }

  private changed(): void {
    this.moving = true
    this.values.clear()
    this.draw()
    this.rest()
  }

  draw(): void {
    if (this.frame) return
    this.frame = requestAnimationFrame((time) => {
      this.frame = 0
      this.adapt(time)
      this.drawNow()
    })
  }

  /** Chooses the level for moving from the time the last frames took. */
  private adapt(time: number): void {
    const took = time - this.lastFrame
    this.lastFrame = time
    if (!this.moving || took > 1000) return
    const coarsest = Math.max(...this.parts.map((p) => p.levelCount), 1) - 1
    if (took > FRAME && this.level < coarsest) this.level++
    else if (took < FRAME / 2.5 && this.level > 0) this.level--
  }

  drawNow(): void {
    for (const part of this.parts) part.setLevel(this.moving ? this.level : 0)
    this.updatePointSize()
    for (const marks of this.marks) marks.update(this.eye, this.renderer.getPixelRatio())
    const ground = getComputedStyle(this.canvas).backgroundColor.match(/\d+/g)?.map(Number) ?? [236, 239, 241]
    this.renderer.setClearColor((ground[0] << 16) | (ground[1] << 8) | ground[2], 1)
    this.renderer.clear()
    this.renderer.render(this.scene, this.eye.camera)
    for (const listener of this.listeners) listener()
  }

  private updatePointSize(): void {
    const ratio = this.renderer.getPixelRatio()
    for (const part of this.parts) {
      if (part.object.kind !== 'points') continue
      const share = part.drawn.geometry.drawRange.count / part.object.vertices
      // Points of a closed surface of this size, evenly spread, are about this far apart.
      const radius = part.object.step * 65535 * 0.5
      const spacing = (radius * 3) / Math.sqrt(Math.max(1, part.object.vertices * share))
      part.materials.own.pointSize.value = ratio * Math.min(24, Math.max(2, spacing / this.eye.millimetresPerPixel))
    }
  }

  /** What follows when nothing more happens: the picture in full, then its values. Until then the stage is busy. */
  private rest(): void {
    this.canvas.ariaBusy = 'true'
    clearTimeout(this.restTimer)
    this.restTimer = window.setTimeout(() => {
      if (this.moving) {
        this.moving = false
        this.draw()
      }
      this.restTimer = window.setTimeout(() => void this.read(), READ)
    }, REST)
  }

  private async read(): Promise<void> {
    if (this.parts.length === 0 || !this.renderer.extensions.has('EXT_color_buffer_float')) return
    await this.values.draw(this.scene, this.parts, this.eye, this.marks.map((m) => m.drawn))
    if (!this.values.ready) return
    this.canvas.ariaBusy = 'false'
    for (const listener of this.listeners) listener()
  }
}

/** Middle of the objects' grids, in double precision. */
function centerOf(state: State): Vector3 {
  const first = state.manifest.objects[0]
  if (!first) return new Vector3()
  return new Vector3(...first.origin.map((o) => o + 32767 * first.step))
}
