import { svg, textWidth } from '../dom'
import type { State } from '../state'
import type { Words } from '../words'
import { barsOf, domainOf } from './axis'
import { hex } from './scale'

/** Where things lie across the axis, in pixels. */
const STRIP = 18
const TICK = 4
/** Between a label and what is beside it. */
const GAP = 3
/** Room for the labels under the strip, lying. */
const FOOT = 44
/** Least room for the bars, and room for the shares beside them, upright. */
const BARS = 30
const SHARE = 56

export interface Drawing {
  /** Least breadth at which all of it is seen: labels are as long as their numbers. */
  breadth: number
  /** Pixel along the axis for a deviation. */
  at(value: number): number
  /** Deviation for a pixel along the axis. */
  value(pixel: number): number
  /** Marks the value under the cursor; none takes the mark away. Nothing else is drawn anew. */
  mark(value: number | null): void
}

/**
 * Scale and histogram on one axis into `target`, `length` pixels along the axis and `breadth` across.
 * Upright: high values at the top, bars grow to the right. Lying: high values to the right, bars grow upward.
 */
export function drawScale(target: SVGSVGElement, state: State, words: Words, length: number, breadth: number, upright: boolean): Drawing {
  const { scale, colors } = state
  const histogram = state.current?.histogram ?? null
  const domain = domainOf(scale, histogram)
  const at = (v: number) => {
    const t = ((v - domain[0]) / (domain[1] - domain[0])) * length
    return upright ? length - t : t
  }
  const value = (pixel: number) => domain[0] + ((upright ? length - pixel : pixel) / length) * (domain[1] - domain[0])
  const [w, h] = upright ? [breadth, length] : [length, breadth]
  target.replaceChildren(svg('title', {}, words.of('figure.title')))
  const rank = (v: number) => (scale.tolerance?.includes(v) ? 0 : v === scale.lower || v === scale.upper ? 1 : 2)
  const labels = colors.limits.map((limit) => ({ limit, text: words.onScale(limit, scale), name: rank(limit) === 0 ? 'tick bold' : 'tick' }))
  const widest = Math.ceil(Math.max(...labels.map(({ text, name }) => textWidth(target, text, name))))
  // Lying, the numbers at both ends reach beyond the axis.
  target.setAttribute('viewBox', upright ? `0 0 ${w} ${h}` : `${-widest / 2} 0 ${w + widest} ${h}`)
  const strip = upright ? widest + 2 * GAP + TICK : breadth - FOOT
  const bars = strip + (upright ? STRIP + 4 : -4)
  const end = upright ? breadth - SHARE : 0
  const room = Math.abs(end - bars)

  /** A box from `a` to `b` along the axis and from `c`, `size` pixels across, away from the strip. */
  const box = (a: number, b: number, c: number, size: number, attributes: Record<string, string | number>) => {
    const from = Math.min(at(a), at(b))
    const long = Math.abs(at(a) - at(b))
    return upright
      ? svg('rect', { x: c, y: from, width: size, height: long, ...attributes })
      : svg('rect', { x: from, y: c - size, width: long, height: size, ...attributes })
  }
  const across = (v: number, from: number, to: number, name: string) => {
    const p = at(v)
    return upright
      ? svg('line', { class: name, x1: from, x2: to, y1: p, y2: p })
      : svg('line', { class: name, x1: p, x2: p, y1: from, y2: to })
  }
  const text = (v: number, c: number, content: string, name: string) =>
    svg('text', upright ? { class: name, x: c, y: at(v) } : { class: name, x: at(v), y: c }, content)

  // The strip: caps and bands, each of which can be chosen.
  const { limits, slots } = colors
  const edges = [domain[0], ...limits, domain[1]]
  const inStrip = upright ? strip : strip + STRIP
  for (let i = 0; i + 1 < edges.length; i++) {
    const smooth = scale.mode === 'continuous' && i > 0 && i + 2 < edges.length
    const [from, to] = [edges[i], edges[i + 1]]
    const pieces = smooth ? 12 : 1
    for (let k = 0; k < pieces; k++) {
      const [a, b] = [from + ((to - from) * k) / pieces, from + ((to - from) * (k + 1)) / pieces]
      const fill = smooth ? colors.css((a + b) / 2) : hex(slots[i])
      target.append(box(a, b, inStrip, STRIP, { fill, class: 'band', 'data-slot': i }))
    }
  }

  if (histogram) {
    const { bars: all, below, above } = barsOf(histogram, domain)
    const size = (count: number) => (state.log ? Math.log10(1 + count) : count)
    const most = Math.max(1e-9, ...all.map((b) => size(b.count)))
    for (const bar of all) {
      const long = (room * 0.97 * size(bar.count)) / most
      const middle = (bar.from + bar.to) / 2
      const dim = state.only && (middle < state.only[0] || middle > state.only[1])
      const name = dim ? 'bar dim' : 'bar'
      target.append(box(bar.from, bar.to, bars, long, { fill: colors.css(middle), class: name, 'data-count': bar.count, 'data-from': bar.from, 'data-to': bar.to }))
    }
    target.dataset.below = String(below)
    target.dataset.above = String(above)
  }

  // Ticks at the limits, the tolerance across the bars, zero and mean.
  const [near, far] = upright ? [strip - TICK, strip] : [strip + STRIP, strip + STRIP + TICK]
  const written: number[] = []
  for (const { limit, text: label, name } of labels.sort((a, b) => rank(a.limit) - rank(b.limit))) {
    target.append(across(limit, near, far, 'tick'))
    if (rank(limit) === 0) target.append(across(limit, far, end, 'limit'))
    if (written.some((w) => Math.abs(w - at(limit)) < (upright ? 12 : widest + 4 * GAP))) continue
    written.push(at(limit))
    target.append(text(limit, upright ? near - GAP : far + 14, label, name))
  }
  if (limits.length % 2 === 0 && limits[0] < 0 && limits[limits.length - 1] > 0) {
    target.append(across(0, near, end, 'zero'))
    if (written.every((w) => Math.abs(w - at(0)) > (upright ? 14 : widest / 2 + 4 * GAP))) target.append(text(0, upright ? near - GAP : far + 12, '0', 'tick'))
  }
  const mean = state.current?.mean
  if (mean !== null && mean !== undefined && mean > domain[0] && mean < domain[1]) target.append(across(mean, bars, end, 'mean'))

  // Shares beside the bands and clear of the bars.
  if (upright) {
    for (let i = 0; i + 1 < edges.length; i++) {
      const found = state.slotShare(i)
      if (found === null) break
      const middle = value((at(edges[i]) + at(edges[i + 1])) / 2)
      if (Math.abs(at(edges[i]) - at(edges[i + 1])) >= 11) target.append(text(middle, breadth - 2, words.share(found), 'share'))
    }
  }
  let marked: SVGElement | null = null
  const mark = (found: number | null) => {
    marked?.remove()
    marked = null
    if (found === null) return
    const v = Math.min(domain[1], Math.max(domain[0], found))
    marked = across(v, upright ? strip - TICK : 0, upright ? end : strip + STRIP, 'hover')
    target.append(marked)
  }
  mark(state.hover)
  return { breadth: strip + STRIP + 4 + BARS + SHARE, at, value, mark }
}
