import type { AnyObject, Manifest, Pick, ScaleObject } from './manifest'
import { Colors, limitsOf, slotOf, widened } from './scale/scale'
import { Distribution, type Share } from './scale/distribution'

/** What the reader can change. Everything that shows it listens. */
export class State {
  scale: ScaleObject
  colors: Colors
  /** Number of the map that is shown. */
  comparison = 0
  /** Only deviations in this range are colored. */
  only: [number, number] | null = null
  /** Deviation under the cursor. */
  hover: number | null = null
  map = true
  flat = false
  perspective = false
  flags = true
  log = false
  backfaces = false
  /** Faces have the colors of their model where no map is shown. */
  modelColors = false
  /** Number of the place chosen in the list; −1 for none. */
  picked = -1
  readonly visible: Record<string, boolean> = {}
  private readonly listeners: ((what: Change) => void)[] = []

  constructor(readonly manifest: Manifest) {
    this.scale = widened({ ...this.opening })
    this.colors = new Colors(this.palettes, this.scale)
    for (const { role, shown } of manifest.objects) this.visible[role] ||= shown && role !== 'before'
    this.backfaces = 'part' in this.visible || 'after' in this.visible
  }

  get current() {
    return this.manifest.maps[this.comparison]
  }

  /** The scale that the map opens with. */
  get opening(): ScaleObject {
    return this.current?.scale ?? this.manifest.scale ?? NO_SCALE
  }

  private get palettes() {
    return this.current?.palettes ?? this.manifest.palettes
  }

  /** Keys of the words for what is mapped, and for the high and the low end of the scale. */
  get quantity(): [string, string, string] {
    return this.current?.quantity ?? this.manifest.quantity
  }

  /** Places that the list leads to now, with their numbers. */
  get picks(): [number, Pick][] {
    return [...this.manifest.picks.entries()].filter(([, p]) => p.map === null || p.map === this.comparison)
  }

  /** Something is shown that has values of the current map. */
  get mapped(): boolean {
    return this.manifest.objects.some((o) => o.kind !== 'marks' && this.visible[o.role] && this.carries(o))
  }

  private carries(o: AnyObject): boolean {
    return o.kind !== 'marks' && o.fields.some((f) => f.comparison === this.comparison)
  }

  /** The page is a drawing in the plane, without a part in space. */
  get planar(): boolean {
    return this.manifest.first === null
  }

  /** The page has charts, and nothing to move. */
  get charted(): boolean {
    return document.getElementById('charts') !== null
  }

  /** There are surfaces, whose inner side can be shown. */
  get meshes(): boolean {
    return this.manifest.objects.some((o) => o.kind === 'mesh' && o.role !== 'element')
  }

  /** There are faces with a color of the model's own. */
  get colored(): boolean {
    return this.manifest.objects.some((o) => o.kind === 'mesh' && o.faces?.list.some((f) => f.color))
  }

  /** What can be switched on and off. */
  get roles(): string[] {
    return Object.keys(this.visible)
  }

  /**
   * Share of the deviations in a range: the result's own number for the tolerance zone, counted where that can be, else
   * about.
   */
  share(from: number, to: number): Share | null {
    const zone = this.current?.tolerance
    if (zone && zone.inside !== null && from === zone.lower && to === zone.upper) return { share: zone.inside, exact: true }
    const edges = [-OPEN, ...this.colors.limits, OPEN]
    const slot = edges.findIndex((edge, i) => from === edge && to === edges[i + 1])
    if (slot >= 0) return this.slotShare(slot)
    const distribution = this.distribution
    return distribution.known ? distribution.between(from, to) : null
  }

  /** Share of the deviations with a color of the scale, 0 being the low cap; a limit belongs to the band nearer the middle. */
  slotShare(slot: number): Share | null {
    const { limits } = this.colors
    const zone = this.current?.tolerance
    if (zone && zone.inside !== null && limits[slot - 1] === zone.lower && limits[slot] === zone.upper) return { share: zone.inside, exact: true }
    const distribution = this.distribution
    if (distribution.complete) return { share: distribution.share((v) => slotOf(limits, v) === slot), exact: true }
    const counted = this.current?.slots
    const opening = limitsOf(widened({ ...this.opening }))
    if (counted && counted.length === limits.length + 1 && limits.every((limit, i) => limit === opening[i]))
      return { share: counted[slot] / counted.reduce((sum, n) => sum + n, 0), exact: true }
    return distribution.known ? distribution.between(limits[slot - 1] ?? -Infinity, limits[slot] ?? Infinity) : null
  }

  private get distribution(): Distribution {
    return new Distribution(this.current?.quantiles ?? [], this.current?.count ?? 0)
  }

  listen(listener: (what: Change) => void): void {
    this.listeners.push(listener)
  }

  private tell(what: Change): void {
    for (const listener of this.listeners) listener(what)
  }

  setScale(part: Partial<ScaleObject>): void {
    this.scale = widened({ ...this.scale, ...part })
    this.colors = new Colors(this.palettes, this.scale)
    this.tell('scale')
  }

  resetScale(): void {
    this.setScale(this.opening)
  }

  setOnly(range: [number, number] | null): void {
    this.only = range
    this.tell('only')
  }

  setHover(value: number | null): void {
    if (value === this.hover) return
    this.hover = value
    this.tell('hover')
  }

  choose(comparison: number): void {
    const before = this.opening
    this.comparison = comparison
    this.picked = -1
    // Another quantity has another scale; what the reader chose of its look stays.
    if (this.opening !== before) {
      const { palette, mode } = this.scale
      this.scale = widened({ ...this.opening, palette, mode: mode === 'go_no_go' && !this.opening.tolerance ? this.opening.mode : mode })
      this.colors = new Colors(this.palettes, this.scale)
      this.only = null
    }
    this.tell('comparison')
  }

  pick(number: number): void {
    this.picked = number
    const mark = this.manifest.picks[number]?.mark ?? -1
    // What is chosen is shown: a value on its map, what has none on the part.
    const place = this.manifest.picks[number]
    const carrier = place && (place.value === null ? 'part' : this.manifest.objects.find((o) => this.carries(o))?.role)
    if (carrier && carrier in this.visible && this.mapped !== (place.value !== null)) this.show(carrier, true)
    for (const o of this.manifest.objects)
      if (o.kind === 'marks' && mark >= o.first && mark < o.first + o.groups.reduce((n, g) => n + g.count, 0)) this.show(o.role, true)
    this.tell('pick')
  }

  toggle(what: 'map' | 'flat' | 'perspective' | 'flags' | 'log' | 'backfaces' | 'modelColors'): void {
    this[what] = !this[what]
    // A surface shows either of both.
    if (what === 'modelColors' && this.modelColors) this.map = false
    if (what === 'map' && this.map) this.modelColors = false
    this.tell(what === 'flags' || what === 'log' ? what : 'look')
  }

  /** Rims in the colors of verdicts belong to the features, not to what is in their place. */
  private followPart(): void {
    const replaced = 'deviation' in this.visible || 'partition' in this.visible
    if (replaced && 'touching' in this.visible) this.visible.touching = this.visible.part
  }

  /** Of what stands in place of each other there is always one: switched off, it gives way to the first of the others. */
  show(role: string, on: boolean): void {
    this.visible[role] = on
    const places = PLACES.find((roles) => roles.includes(role)) ?? []
    const others = places.filter((r) => r !== role && r in this.visible)
    others.forEach((other, n) => (this.visible[other] = !on && n === 0))
    if (places.includes('part')) this.followPart()
    this.tell('look')
  }
}

export type Change = 'scale' | 'only' | 'hover' | 'comparison' | 'look' | 'flags' | 'log' | 'pick'

/** Roles that stand in place of each other. */
const PLACES = [['after', 'before'], ['part', 'deviation', 'partition']]

/** The end of a range that has none: a number, for links and the GPU. */
export const OPEN = 1e29

/** Stands in where nothing is mapped. */
const NO_SCALE: ScaleObject = { mode: 'bands', lower: -1, upper: 1, tolerance: null, bands: 1, palette: '', decimals: 3, unit: 'mm' }
