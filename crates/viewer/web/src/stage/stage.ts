import { ColorManagement, Group, LinearSRGBColorSpace, Scene, Vector3, WebGLRenderer, type Object3D } from 'three'
import { decodeAll } from '../decode/client'
import type { Pick } from '../manifest'
import type { State } from '../state'
import { Eye, type StandardView } from './eye'
import { applyLook } from './look'
import { Flight } from './flight'
import { Front } from './front'
import { Marks } from './marks'
import { Pace } from './pace'
import { Part } from './part'
import { OBLIQUE } from './shaders'
import { Sight } from './sight'
import { ValueBuffer } from './values'

ColorManagement.enabled = false

/** After this long without movement the picture is drawn in full. */
const REST = 150
/** And after this long its values are read. */
const READ = 120
/** Until the next look at whether frames are finished. */
const AGAIN = 20
/** Pixels of the coarsest picture while moving, for one of the full one along a side. */
const ROUGH = 0.5
/** The closest view is this many steps of the drawing's grid high. */
const FINEST = 500
/** Least room for a column of flags: with values, and with numbers alone where the stage is narrow; and the most, of its width. */
const FLAGS = { wide: 150, narrow: 48, most: 0.24 }
/** Stages narrower than this have flags with numbers alone. */
export const NARROW = 700
/** Room above and below the toolbar, which the part keeps clear of where the stage is narrow. */
const TOOLS = 8

/** The 3D stage: draws on demand only, never at rest. */
export class Stage {
  readonly renderer: WebGLRenderer
  readonly scene = new Scene()
  readonly eye: Eye
  readonly values: ValueBuffer
  private readonly front: Front
  private readonly sight: Sight
  readonly parts: Part[] = []
  readonly marks: Marks[] = []
  /** The parts' edges. */
  private readonly edges = new Group()
  /** Middle of everything in the model's coordinates. */
  readonly center: Vector3
  private readonly pace: Pace
  private moving = false
  /** Nothing is drawn before everything is there: large objects take seconds on slow machines. */
  private open = false
  /** The view is a fitted one that the reader has not moved since. */
  private fitted = true
  private ground: number | null = null
  /** Pixels that a column of flags takes. */
  room = (): number => 0
  private ratio = 1
  private frame = 0
  /** Another frame is to follow the one that is not finished. */
  private wanted = false
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
    this.front = new Front(this.renderer)
    this.values = new ValueBuffer(this.renderer, this.front)
    this.pace = new Pace(this.renderer.getContext() as WebGL2RenderingContext, () => this.wanted && this.draw())
    this.eye = new Eye(state.manifest.up)
    this.sight = new Sight(this.eye, this.values, () => this.shown, () => this.surfaces)
    this.center = centerOf(state)
    this.eye.lookFrom(new Vector3(...(state.manifest.first?.toward ?? [0, 0, 1])))
    this.scene.matrixAutoUpdate = false
    // First, and so under all marks.
    this.scene.add(this.edges)
    applyLook(state)
  }

  /** Decodes all objects, those of the first view first. */
  async load(): Promise<void> {
    // What the first view shows comes first.
    const wanted = [...this.state.manifest.objects].sort((a, b) => Number(this.state.visible[b.role]) - Number(this.state.visible[a.role]))
    await decodeAll(wanted, (object, decoded) => {
      if (object.kind === 'marks') {
        const marks = new Marks(object, decoded, this.center)
        this.marks.push(marks)
        this.scene.add(marks.drawn)
        this.applyState()
        return this.frameAll()
      }
      const part = new Part(object, decoded, this.center)
      this.parts.push(part)
      this.scene.add(part.drawn)
      if (part.edges) this.edges.add(part.edges.drawn)
      this.measure()
      this.pace.forget()
      if (part.drawn.visible) this.frameAll()
      this.applyState()
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
    this.ratio = Math.min(2, window.devicePixelRatio)
    // The canvas takes whole pixels, however the page's columns fall: else the picture is resampled and blurs.
    this.renderer.setSize(this.eye.width, this.eye.pixels, true)
    if (first) this.frameAll()
    this.pace.forget()
    if (this.open) this.settle()
  }

  /** Draws from now on. */
  show(): void {
    this.open = true
    this.settle()
  }

  /** The page's colors have changed. */
  recolor(): void {
    this.ground = null
    this.draw()
  }

  get shown(): Part[] {
    return this.parts.filter((p) => p.drawn.visible)
  }

  /**
   * What hides places where a cloud is shown: the reference that it is compared with, shown or not, where the report has
   * it, else what is shown. `null` where no cloud is.
   */
  private get surfaces(): Part[] | null {
    const { shown } = this
    if (!shown.some((p) => p.object.kind === 'points')) return null
    const references = this.parts.filter(({ object }) => object.kind === 'mesh' && object.role === 'reference' && (object.comparison ?? this.state.comparison) === this.state.comparison)
    return references.length > 0 ? references : shown
  }

  part(object: number): Part | undefined {
    return this.parts.find((p) => p.object.id === object)
  }

  fit(): void {
    this.frameAll()
    this.moved()
    this.fitted = true
  }

  /** Frames what is shown, and the flags' places that lie off it; draws nothing. */
  private frameAll(): void {
    const { flags, picks, mapped } = this.state
    const flagged = flags ? picks.filter(([, p]) => (mapped ? p.value !== null : p.frame !== null)) : []
    const narrow = this.eye.width < NARROW
    const margin = flagged.length === 0 ? 0 : narrow ? FLAGS.narrow : Math.max(FLAGS.wide, Math.min(this.room(), this.eye.width * FLAGS.most))
    const marks = this.marks.filter((m) => m.drawn.visible)
    const off = flagged.filter(([, p]) => p.off).map(([, p]) => this.placeOf(p))
    const places = [...this.shown.flatMap((p) => p.sample(20000)), ...marks.flatMap((m) => m.sample(2000)), ...off]
    this.eye.fit(places, margin, narrow ? this.head() : 0)
  }

  private head(): number {
    const tools = this.canvas.parentElement?.querySelector<HTMLElement>('.stage-tools')
    return (tools?.offsetHeight ?? 0) + 2 * TOOLS
  }

  /** Place of a pick relative to the stage's center. */
  placeOf(pick: Pick): Vector3 {
    return this.fromCenter(pick.position)
  }

  /**
   * Where the leader to a pick ends in this view, whether that is hidden, as its own place is if only that were seen, and whether what it says is
   * reached there.
   */
  endOf(pick: Pick): { place: Vector3; hidden: boolean; reached: boolean } {
    const slack = this.slackOf(pick)
    const own = this.placeOf(pick)
    if (!this.sight.hidden(own, slack)) return { place: own, hidden: false, reached: true }
    const others = pick.others.map((other) => this.fromCenter(other))
    const seen = others.findIndex((other) => !this.sight.hidden(other, slack))
    return seen < 0 ? { place: own, hidden: true, reached: true } : { place: others[seen], hidden: false, reached: seen < pick.reached }
  }

  /** The place that it was measured from, likewise. */
  surfaceOf(pick: Pick): Vector3 | null {
    return pick.surface && this.fromCenter(pick.surface)
  }

  /** How far a pick may lie under the surface it belongs to and still be seen on it, millimeters. */
  slackOf(pick: Pick): number {
    return pick.off ? 0 : OBLIQUE * (this.surfaceOf(pick)?.distanceTo(this.placeOf(pick)) ?? 0)
  }

  private fromCenter(place: [number, number, number]): Vector3 {
    return new Vector3(...place.map((x, k) => x - this.center.getComponent(k)))
  }

  look(view: StandardView): void {
    this.eye.look(view)
    this.fit()
  }

  /** Brings a place of the list to the middle: near, where it has a size, and from the side that shows it. */
  flyTo(pick: Pick): void {
    const target = this.placeOf(pick)
    this.fitted = false
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
    this.fitted = false
    this.flight.stop()
    this.changed()
  }

  private changed(): void {
    this.moving = true
    this.values.clear()
    this.draw()
    this.rest()
  }

  /** Draws in the browser's next frame, but never more than one frame ahead of the GPU: the hand would be followed late. */
  draw(): void {
    if (!this.open) return
    this.wanted = this.pace.busy
    if (this.frame || this.wanted) return
    this.frame = requestAnimationFrame(() => {
      this.frame = 0
      this.drawNow()
    })
  }

  drawNow(): void {
    // After the coarsest level of detail one more, in which pixels are larger too.
    const coarsest = Math.max(...this.parts.map((p) => p.levelCount), 1)
    const level = this.moving ? this.pace.level(coarsest) : 0
    for (const part of this.parts) part.setLevel(level)
    this.setRatio(level === coarsest ? this.ratio * ROUGH : this.ratio)
    const surfaces = this.moving || !this.readable ? null : this.surfaces
    if (surfaces?.some((p) => p.object.kind === 'mesh')) this.front.draw(this.scene, this.parts, this.eye, surfaces, this.besides)
    for (const part of this.parts) part.setPoints(this.eye.millimetresPerPixel, this.renderer.getPixelRatio())
    for (const marks of this.marks) marks.update(this.eye, this.renderer.getPixelRatio())
    const edged = this.parts.some((p) => p.drawn.visible && p.edges && !p.sinks)
    for (const part of this.parts) part.setEye(this.eye, this.renderer.getPixelRatio(), edged)
    this.renderer.setClearColor((this.ground ??= this.groundColor()), 1)
    const begin = performance.now()
    this.renderer.clear()
    this.renderer.render(this.scene, this.eye.camera)
    this.front.leave(this.parts)
    this.pace.follow(begin, this.moving ? { level, coarsest } : null)
    for (const listener of this.listeners) listener()
  }

  /** Pixels of the drawing for one of the page. */
  private setRatio(ratio: number): void {
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio)
  }

  private groundColor(): number {
    const [r, g, b] = getComputedStyle(this.canvas).backgroundColor.match(/\d+/g)?.map(Number) ?? [236, 239, 241]
    return (r << 16) | (g << 8) | b
  }

  /**
   * The view as it is, drawn in full at another size on the canvas's own color. `look` is called while it stands, when
   * what lies over it is laid out for that size. Where nothing is shown it is the reference, or what the page opens with: an empty
   * sheet tells nobody anything.
   */
  pictureOf(width: number, height: number, ratio: number, room: () => number, look: () => void): string {
    const { eye, renderer } = this
    const before = { room: this.room, width: eye.width, pixels: eye.pixels, ratio: this.ratio, eye: eye.save(), moving: this.moving }
    this.moving = false
    this.room = room
    eye.width = width
    eye.pixels = height
    this.ratio = ratio
    renderer.setSize(width, height, false)
    const added = this.shown.length > 0 || this.marks.some((m) => m.drawn.visible) ? [] : this.inPlaceOfNothing
    for (const part of added) part.drawn.visible = true
    if (this.fitted) this.frameAll()
    this.values.clear()
    this.ground = null
    this.drawNow()
    const picture = this.canvas.toDataURL('image/png')
    look()
    for (const part of added) part.drawn.visible = false
    this.room = before.room
    eye.width = before.width
    eye.pixels = before.pixels
    eye.restore(before.eye)
    this.ratio = before.ratio
    renderer.setSize(before.width, before.pixels, true)
    this.moving = before.moving
    this.ground = null
    return picture
  }

  /** What a picture shows where the reader has switched off everything. */
  private get inPlaceOfNothing(): Part[] {
    const here = this.parts.filter(({ object }) => object.comparison === null || object.comparison === this.state.comparison)
    const references = here.filter(({ object }) => object.role === 'reference')
    return references.length > 0 ? references : here.filter(({ object }) => object.shown)
  }

  /** What follows when nothing more happens: the picture in full, then its values. Until then the stage is busy. */
  private rest(): void {
    this.canvas.ariaBusy = 'true'
    if (!this.open) return
    clearTimeout(this.restTimer)
    this.restTimer = window.setTimeout(() => this.still(), REST)
  }

  /** The hand is still when nothing has come for a while after the last frame was finished: a slow frame is no pause. */
  private still(): void {
    const since = performance.now() - this.pace.finished
    if (this.drawing || (this.moving && since < REST)) {
      this.restTimer = window.setTimeout(() => this.still(), Math.max(AGAIN, REST - since))
      return
    }
    if (this.moving) {
      this.moving = false
      this.draw()
    }
    this.restTimer = window.setTimeout(() => this.readWhenDrawn(), READ)
  }

  private readWhenDrawn(): void {
    if (this.drawing) this.restTimer = window.setTimeout(() => this.readWhenDrawn(), AGAIN)
    else void this.read()
  }

  /** A frame is asked for or not finished. */
  private get drawing(): boolean {
    return this.frame !== 0 || this.wanted || this.pace.busy
  }

  /** Numbers can be drawn and read. */
  private get readable(): boolean {
    return this.renderer.extensions.has('EXT_color_buffer_float')
  }

  /** What is drawn beside the parts and has no values. */
  private get besides(): Object3D[] {
    return [this.edges, ...this.marks.map((m) => m.drawn)]
  }

  /** Draws and reads anew what another size has left behind. */
  settle(): void {
    cancelAnimationFrame(this.frame)
    this.frame = 0
    this.wanted = false
    this.values.clear()
    this.drawNow()
    this.rest()
  }

  private async read(): Promise<void> {
    if (this.parts.length === 0 || !this.readable) return
    await this.values.draw(this.scene, this.parts, this.eye, this.surfaces, this.besides)
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
