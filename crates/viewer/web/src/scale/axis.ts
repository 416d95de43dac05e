import type { Histogram, ScaleObject } from '../manifest'

/** Least share of the axis that the scale itself takes. */
const SCALE_SHARE = 0.62
/** Share of each cap where the histogram does not reach beyond the scale. */
const CAP_SHARE = 0.045

/** The range of the common axis of scale and histogram: the scale, its caps, and the histogram as far as there is room. */
export function domainOf(scale: ScaleObject, histogram: Histogram | null): [number, number] {
  const width = scale.upper - scale.lower
  const cap = (CAP_SHARE * width) / (1 - 2 * CAP_SHARE)
  const most = (width * (1 / SCALE_SHARE - 1)) / 2
  const reach = (beyond: number) => Math.min(Math.max(beyond, cap), most)
  const edges = histogram?.edges ?? [scale.lower, scale.upper]
  return [scale.lower - reach(scale.lower - edges[0]), scale.upper + reach(edges[edges.length - 1] - scale.upper)]
}

export interface Bar {
  from: number
  to: number
  count: number
}

/** Bars within the domain, and the counts beyond it at both ends. */
export function barsOf(histogram: Histogram, domain: [number, number]): { bars: Bar[]; below: number; above: number } {
  const bars: Bar[] = []
  let { below, above } = histogram
  histogram.counts.forEach((count, i) => {
    const [from, to] = [histogram.edges[i], histogram.edges[i + 1]]
    if (to <= domain[0]) below += count
    else if (from >= domain[1]) above += count
    else bars.push({ from: Math.max(from, domain[0]), to: Math.min(to, domain[1]), count })
  })
  return { bars, below, above }
}
