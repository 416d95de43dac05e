import type { Manifest, ScaleObject } from './manifest'
import { Colors } from './scale/scale'
import { Distribution } from './scale/distribution'

/** What the reader can change. Everything that shows it listens. */
export class State {
  scale: ScaleObject
  colors: Colors
  /** Number of the comparison that is shown. */
  comparison = 0
  /** Only deviations in this range are coloured. */
  only: [number, number] | null = null
  /** Deviation under the cursor. */
  hover: number | null = null
  map = true
  flat = false
  perspective = false
  flags = true
  log = false
  visible: Record<'measured' | 'reference', boolean>
  private readonly listeners: ((what: Change) => void)[] = []

  constructor(readonly manifest: Manifest) {
    this.scale = { ...manifest.result.scale }
    this.colors = new Colors(manifest, this.scale)
    this.visible = firstView(manifest)
  }

  get current() {
    return this.manifest.result.comparisons[this.comparison]
  }

  /** Share of the deviations in a range: the result's own number for the tolerance zone, else from the distribution. */
  share(from: number, to: number): number | null {
    const zone = this.current?.tolerance
    if (zone && from === zone.lower && to === zone.upper) return zone.inside
    const distribution = new Distribution(this.manifest.quantiles[this.comparison] ?? [])
    return distribution.known ? distribution.between(from, to) : null
  }

  listen(listener: (what: Change) => void): void {
    this.listeners.push(listener)
  }

  private tell(what: Change): void {
    for (const listener of this.listeners) listener(what)
  }

  setScale(part: Partial<ScaleObject>): void {
    this.scale = { ...this.scale, ...part }
    this.colors = new Colors(this.manifest, this.scale)
    this.tell('scale')
  }

  resetScale(): void {
    this.setScale(this.manifest.result.scale)
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
    this.comparison = comparison
    this.tell('comparison')
  }

  toggle(what: 'map' | 'flat' | 'perspective' | 'flags' | 'log'): void {
    this[what] = !this[what]
    this.tell(what === 'flags' ? 'flags' : what === 'log' ? 'log' : 'look')
  }

  show(role: 'measured' | 'reference', on: boolean): void {
    this.visible[role] = on
    this.tell('look')
  }
}

export type Change = 'scale' | 'only' | 'hover' | 'comparison' | 'look' | 'flags' | 'log'

/** The measured mesh alone; else the reference that carries the map; else the measured points over the reference. */
function firstView(manifest: Manifest): State['visible'] {
  const mapped = (role: string) => manifest.objects.some((o) => o.role === role && o.kind === 'mesh' && o.fields.length > 0)
  if (mapped('measured')) return { measured: true, reference: false }
  if (mapped('reference')) return { measured: false, reference: true }
  return { measured: true, reference: true }
}
