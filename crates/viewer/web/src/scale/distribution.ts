/** A share of the values (0 to 1). */
export interface Share {
  share: number
  /** Counted, not told from quantiles. */
  exact: boolean
}

/** Shares of values: counted where all of them are at hand, told from evenly spaced quantiles where they are not. */
export class Distribution {
  /** `quantiles` rise, and are all of the `count` values where they are as many. */
  constructor(
    private readonly quantiles: number[],
    count: number,
  ) {
    this.complete = quantiles.length > 0 && quantiles.length >= count
    // A single value stands at both ends.
    if (this.complete) this.quantiles = quantiles.slice(0, count)
  }

  readonly complete: boolean

  get known(): boolean {
    return this.complete || this.quantiles.length > 1
  }

  /** Share of values in `[from, to]`. */
  between(from: number, to: number): Share {
    if (this.complete) return { share: this.share((v) => v >= from && v <= to), exact: true }
    return { share: Math.max(0, this.about(to, true) - this.about(from, false)), exact: false }
  }

  /** Share of the values that are meant; only where all are at hand. */
  share(meant: (value: number) => boolean): number {
    return this.quantiles.filter(meant).length / this.quantiles.length
  }

  /** About the share of values below `x`, or below and at it. */
  private about(x: number, inclusive: boolean): number {
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
