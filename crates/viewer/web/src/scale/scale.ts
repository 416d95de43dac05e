import type { Palettes, ScaleObject } from '../manifest'

export type Rgb = [number, number, number]

/** Where the color changes: the same rule as the program's, because the reader can change the range. */
export function limitsOf(scale: ScaleObject): number[] {
  const zone = scale.tolerance
  if (scale.mode === 'go_no_go') return zone ? [...zone] : [scale.lower, scale.upper]
  if (!zone) return steps(scale.lower, scale.upper, scale.bands)
  const side = Math.max(1, Math.floor(scale.bands / 2))
  return [...steps(scale.lower, zone[0], side), ...steps(zone[1], scale.upper, side)]
}

/** The range with the tolerance zone in it: what is within tolerance is green whatever the range. */
export function widened(scale: ScaleObject): ScaleObject {
  const zone = scale.tolerance
  return zone ? { ...scale, lower: Math.min(scale.lower, zone[0]), upper: Math.max(scale.upper, zone[1]) } : scale
}

function steps(from: number, to: number, n: number): number[] {
  return Array.from({ length: n + 1 }, (_, i) => (i === n ? to : from + (i / n) * (to - from)))
}

/** 0 is the low cap, then the bands from low to high, last the high cap. A limit belongs to the band nearer the middle. */
export function slotOf(limits: number[], value: number): number {
  const middle = limits.length >> 1
  let slot = middle
  for (let i = middle; i < limits.length; i++) if (value > limits[i]) slot++
  for (let i = 0; i < middle; i++) if (value < limits[i]) slot--
  return slot
}

/** Colors of a scale: those of the slots, and the ramp for continuous mode. All come from the file. */
export class Colors {
  readonly limits: number[]
  readonly slots: Rgb[]
  readonly ramp: Rgb[]

  constructor(
    palettes: Palettes | null,
    readonly scale: ScaleObject,
  ) {
    const palette = palettes?.[scale.palette] ?? { bands: '', ramp: '', go_no_go: '' }
    this.limits = limitsOf(scale)
    this.slots = parse(scale.mode === 'go_no_go' ? palette.go_no_go : palette.bands)
    this.ramp = parse(palette.ramp)
  }

  of(value: number): Rgb {
    const { lower, upper, mode } = this.scale
    const slot = slotOf(this.limits, value)
    if (mode !== 'continuous' || value < lower || value > upper) return this.slots[slot]
    const zone = this.scale.tolerance
    if (!zone) return this.ramp[step((value - lower) / (upper - lower), 0, 256)]
    // Half of the ramp lies below the zone and half above.
    if (value < zone[0]) return this.ramp[step((value - lower) / (zone[0] - lower), 0, 128)]
    if (value > zone[1]) return this.ramp[step((value - zone[1]) / (upper - zone[1]), 128, 128)]
    return this.slots[slot]
  }

  css(value: number): string {
    return hex(this.of(value))
  }
}

const step = (share: number, from: number, count: number) => from + Math.min(count - 1, Math.floor(share * count))

export function parse(text: string): Rgb[] {
  return (text.match(/.{6}/g) ?? []).map((c) => [0, 2, 4].map((k) => parseInt(c.slice(k, k + 2), 16)) as Rgb)
}

export function hex(c: Rgb): string {
  return `#${c.map((x) => x.toString(16).padStart(2, '0')).join('')}`
}
