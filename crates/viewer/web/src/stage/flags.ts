import { Vector3 } from 'three'
import { el, svg } from '../dom'
import type { Pick } from '../manifest'
import type { State } from '../state'
import type { Words } from '../words'
import type { Stage } from './stage'

/** Room between flags of one column. */
const GAP = 6
/** Height that the view cube takes in the corner at the right. */
const CUBE = 110

interface Flag {
  number: number
  place: Vector3
  box: HTMLButtonElement
  line: SVGLineElement
  dot: SVGCircleElement
}

interface Placed {
  flag: Flag
  x: number
  y: number
  top: number
}

/** The worst places, each with a leader line from a column beside the part. */
export class Flags {
  private flags: Flag[] = []
  private readonly lines = svg('svg', { class: 'leaders', 'aria-hidden': 'true' })
  constructor(
    private readonly overlay: HTMLElement,
    private readonly stage: Stage,
    private readonly state: State,
    private readonly words: Words,
  ) {
    overlay.append(this.lines)
    stage.onDraw(() => this.place())
    words.onChange(() => this.rebuild())
    state.listen((what) => {
      if (what === 'comparison' || what === 'flags' || what === 'scale') this.rebuild()
      if (what === 'pick') this.place()
    })
    this.rebuild()
  }

  private rebuild(): void {
    for (const flag of this.flags) flag.box.remove()
    this.lines.replaceChildren()
    const valued = this.state.flags ? this.state.picks : []
    this.flags = valued.flatMap(([number, p], n) => (p.value === null ? [] : [this.make(number, p, p.value, n)]))
    this.place()
  }

  private make(number: number, pick: Pick, value: number, n: number): Flag {
    const zone = this.state.scale.tolerance
    const out = zone ? value < zone[0] || value > zone[1] : false
    const box = el(
      'button',
      { type: 'button', class: out ? 'flag out' : 'flag', 'data-flag': n },
      el('span', { class: 'number' }, String(n + 1)),
      el('strong', {}, this.words.signed(value, this.state.scale.decimals)),
    )
    box.style.setProperty('--swatch', this.state.colors.css(value))
    box.addEventListener('click', () => this.state.pick(number))
    const line = svg('line', { class: 'leader' })
    const dot = svg('circle', { class: 'anchor', r: 3.5 })
    this.lines.append(line, dot)
    this.overlay.append(box)
    const place = new Vector3(...pick.position.map((x, k) => x - this.stage.center.getComponent(k)))
    return { number, place, box, line, dot }
  }

  /** Puts the flags beside the part, nearest side first, without crossing leaders. */
  private place(): void {
    const { width, pixels } = this.stage.eye
    this.lines.setAttribute('viewBox', `0 0 ${width} ${pixels}`)
    const middle = width / 2
    const columns: [Placed[], Placed[]] = [[], []]
    for (const flag of this.flags) {
      const p = this.stage.eye.project(flag.place)
      columns[p.x < middle ? 0 : 1].push({ flag, x: p.x, y: p.y, top: 0 })
      const hidden = this.hidden(p)
      flag.box.classList.toggle('hidden', hidden)
      flag.line.classList.toggle('hidden', hidden)
      flag.box.classList.toggle('selected', flag.number === this.state.picked)
      flag.dot.setAttribute('cx', String(p.x))
      flag.dot.setAttribute('cy', String(p.y))
    }
    columns.forEach((column, side) => this.stack(column, side === 1, width, pixels))
  }

  /** Another surface lies before the place. Unknown (not hidden) while the values are not read. */
  private hidden(p: { x: number; y: number; depth: number }): boolean {
    const { values, eye } = this.stage
    if (!values.ready) return false
    const tolerance = Math.max(6 * eye.millimetresPerPixel, 0.01 * eye.height)
    const near = [-1, 0, 1].flatMap((i) => [-1, 0, 1].map((j) => values.at(p.x + i, p.y + j)))
    const seen = near.filter((r) => r !== null)
    if (seen.length === 0) return false
    return seen.every((r) => r.depth > p.depth + tolerance)
  }

  private stack(column: Placed[], right: boolean, width: number, height: number): void {
    column.sort((a, b) => a.y - b.y)
    const tall = Math.max(...column.map((c) => c.flag.box.offsetHeight), 24)
    let free = 44
    for (const c of column) {
      c.top = Math.max(free, c.y - tall / 2)
      free = c.top + tall + GAP
    }
    let limit = height - (right && width > 600 ? CUBE : 8)
    for (const c of [...column].reverse()) {
      c.top = Math.min(c.top, limit - tall)
      limit = c.top - GAP
    }
    const inner = (c: Placed) => (right ? width - 8 - c.flag.box.offsetWidth : 8 + c.flag.box.offsetWidth)
    uncross(column, (c) => [inner(c), c.top + tall / 2])
    for (const c of column) {
      c.flag.box.style.top = `${c.top}px`
      c.flag.box.style.left = right ? 'auto' : '8px'
      c.flag.box.style.right = right ? '8px' : 'auto'
      const ends = { x1: inner(c), y1: c.top + tall / 2, x2: c.x, y2: c.y }
      for (const [name, value] of Object.entries(ends)) c.flag.line.setAttribute(name, String(value))
    }
  }
}

/** Swaps places of flags whose leaders cross; each swap shortens the leaders, so it ends. */
function uncross(column: Placed[], start: (c: Placed) => [number, number]): void {
  for (let again = true, rounds = 0; again && rounds < 100; rounds++) {
    again = false
    for (let i = 0; i < column.length; i++)
      for (let j = i + 1; j < column.length; j++) {
        const [a, b] = [column[i], column[j]]
        if (cross(start(a), [a.x, a.y], start(b), [b.x, b.y])) {
          ;[a.top, b.top] = [b.top, a.top]
          again = true
        }
      }
  }
}

type Spot = [number, number]

/** The inner parts of two lines meet. */
function cross(a: Spot, b: Spot, c: Spot, d: Spot): boolean {
  const side = (p: Spot, q: Spot, r: Spot) => Math.sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0
}
