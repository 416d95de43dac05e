/** Shares of the deviations, from evenly spaced quantiles. */
export class Distribution {
  constructor(private readonly quantiles: number[]) {}

  get known(): boolean {
    return this.quantiles.length > 1
  }

  /** Share of values in `[from, to]`. */
  between(from: number, to: number): number {
    return Math.max(0, this.share(to, true) - this.share(from, false))
  }

  /** Share of values below `x`, or below and at it. */
  private share(x: number, inclusive: boolean): number {
    const q = this.quantiles
    const last = q.length - 1
    // First quantile that is greater (or not less): binary search.
    let low = 0
    let high = q.length
    while (low < high) {
      const middle = (low + high) >> 1
      if (inclusive ? q[middle] <= x : q[middle] < x) low = middle + 1
      else high = middle
    }
    if (low === 0) return 0
    if (low > last) return 1
    const a = q[low - 1]
    const b = q[low]
    const within = b > a ? Math.min(1, Math.max(0, (x - a) / (b - a))) : 0
    return (low - 1 + within) / last
  }
}
