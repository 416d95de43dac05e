import type { Vector3 } from 'three'
import { el, need, svg, textWidth } from '../dom'
import type { Pick } from '../manifest'
import type { State } from '../state'
import type { Words } from '../words'
import { frameCells, frameText, signOf } from './frame'
import { NARROW, type Stage } from './stage'

/** Room between flags of one column, and between a flag and the stage's rim. */
const GAP = 6
const RIM = 8
/** How far a leader runs straight out of the column of flags before it turns to its place. */
const STUB = 6
/** Half the room that a leader takes where it runs between flags of the other column. */
const LEADER = 9
/** Height that the view cube takes in the corner at the right. */
const CUBE = 110
/** Height of the line at the foot. */
const FOOT = 34
/** Height of a flag on paper, room at both its ends, and width of a sign. */
const PAPER = { height: 28, rim: 8, sign: 22 }

interface Flag {
  number: number
  pick: Pick
  /** Where the place was measured from, if that is far away. */
  surface: Vector3 | null
  label: string
  text: string
  box: HTMLButtonElement
  size: { width: number; height: number }
  line: SVGLineElement
  /** From the flag to where the leader begins, beside the widest flag of the column. */
  stub: SVGLineElement
  /** From the place to the surface. */
  way: SVGLineElement
  dot: SVGCircleElement
}

interface Placed {
  flag: Flag
  hidden: boolean
  /** Whether what it says is reached where the leader ends: elsewhere it has no dot. */
  reached: boolean
  width: number
  height: number
  /** The place, the end of the flag that looks to it, and where the leader begins: no flag of the column reaches as far. */
  x: number
  y: number
  inner: number
  start: number
  /** The place lies on the stage; a leader to another one would only run out of the picture. */
  within: boolean
  /** Left end of the flag: columns stay at the rims, wherever the places lie. */
  left: number
  top: number
}

/** The worst places, each with a leader line from a column beside the part. */
export class Flags {
  private flags: Flag[] = []
  private readonly lines = svg('svg', { class: 'leaders', 'aria-hidden': 'true' })
  private narrow: boolean | null = null
  /** Whether values were shown when the flags were made: without them there are none. */
  private mapped = false

  constructor(
    private readonly overlay: HTMLElement,
    private readonly stage: Stage,
    private readonly state: State,
    private readonly words: Words,
  ) {
    overlay.append(this.lines)
    stage.room = () => this.room
    stage.onDraw(() => this.place())
    words.onChange(() => this.rebuild())
    state.listen((what) => {
      if (what === 'comparison' || what === 'flags' || what === 'scale' || (what === 'look' && this.mapped !== state.mapped)) this.rebuild()
      if (what === 'pick') this.place()
    })
    this.rebuild()
  }

  private rebuild(): void {
    for (const flag of this.flags) flag.box.remove()
    this.lines.replaceChildren()
    this.mapped = this.state.mapped
    const picks = this.state.flags ? this.state.picks : []
    const flagged = picks.filter(([, p]) => (this.mapped ? p.value !== null : p.frame !== null))
    this.flags = flagged.map(([number, p], n) => this.make(number, p, n))
    this.narrow = null
    this.place()
  }

  private make(number: number, pick: Pick, n: number): Flag {
    const { frame } = pick
    const value = pick.value ?? 0
    const label = frame?.id ?? String(n + 1)
    const text = frame ? frameText(frame, this.words) : this.words.onScale(value, this.state.scale)
    const zone = this.state.scale.tolerance
    const out = zone ? value < zone[0] || value > zone[1] : false
    const kind = frame ? `flag frame ${frame.verdict}` : out ? 'flag out' : 'flag'
    const title = frame ? `${text} · ${this.words.of(`verdict.${frame.verdict}`)}` : text
    const box = el(
      'button',
      { type: 'button', class: kind, 'data-flag': n, title },
      el('span', { class: 'number' }, label),
      ...(frame ? frameCells(frame, this.words) : [el('strong', {}, text)]),
      ...(pick.off ? [el('small', {}, this.words.of('flag.off'))] : []),
    )
    if (!frame) box.style.setProperty('--swatch', this.state.colors.css(value))
    box.addEventListener('click', () => this.state.pick(number))
    const line = svg('line', { class: 'leader' })
    const stub = svg('line', { class: 'stub' })
    const way = svg('line', { class: 'way' })
    const dot = svg('circle', { class: pick.off ? 'anchor off' : 'anchor', r: 3.5 })
    this.lines.append(way, stub, line, dot)
    this.overlay.append(box)
    const surface = pick.off ? this.stage.surfaceOf(pick) : null
    return { number, pick, surface, label, text, box, line, stub, way, dot, size: { width: 0, height: 0 } }
  }

  /** Numbers alone where there is no room for values; sizes are read once, not in every frame. */
  private size(): void {
    const narrow = this.stage.eye.width < NARROW
    if (narrow === this.narrow) return
    this.narrow = narrow
    this.overlay.classList.toggle('narrow', narrow)
    for (const { box, size } of this.flags) Object.assign(size, { width: box.offsetWidth, height: box.offsetHeight })
  }

  /** Pixels that a column of flags takes. */
  private get room(): number {
    this.size()
    return RIM + Math.max(0, ...this.flags.map((f) => f.size.width)) + 2 * GAP
  }

  /** The same on paper. */
  get roomOnPaper(): number {
    return RIM + Math.max(0, ...this.flags.map((f) => this.sizeOnPaper(f).width)) + 2 * GAP
  }

  /** Puts the flags beside the part, nearest side first, without crossing leaders. */
  private place(): void {
    this.size()
    const { width, pixels } = this.stage.eye
    this.lines.setAttribute('viewBox', `0 0 ${width} ${pixels}`)
    const tools = this.overlay.querySelector<HTMLElement>('.stage-tools')?.offsetHeight ?? 0
    const placed = this.layout((f) => f.size, tools + 2 * RIM)
    const marks = (flag: Flag) => [flag.stub, flag.line, flag.dot, flag.way]
    for (const flag of this.flags) for (const e of [flag.box, ...marks(flag)]) e.classList.add('left-out')
    for (const c of placed) {
      const { flag, hidden, x, y, inner, start, left, top } = c
      flag.box.classList.remove('left-out')
      for (const e of marks(flag)) e.classList.toggle('left-out', !c.within)
      flag.dot.classList.toggle('left-out', !c.within || !c.reached)
      for (const e of [flag.box, flag.stub, flag.line, flag.dot]) e.classList.toggle('hidden', hidden || !c.within)
      flag.box.classList.toggle('selected', flag.number === this.state.picked)
      flag.box.style.top = `${top}px`
      flag.box.style.left = `${left}px`
      const middle = top + c.height / 2
      write(flag.stub, { x1: inner, y1: middle, x2: start, y2: middle })
      write(flag.line, { x1: start, y1: middle, x2: x, y2: y })
      write(flag.dot, { cx: x, cy: y })
      const foot = flag.surface ? this.stage.eye.project(flag.surface) : { x, y }
      write(flag.way, { x1: x, y1: y, x2: foot.x, y2: foot.y })
    }
  }

  /** What a flag says on paper: its label, a sign if it has one, and the rest, with the places from its left end where they begin. */
  private onPaper({ pick, label, text }: Flag): { sign: number; start: number; said: string } {
    const said = pick.off ? `${text} · ${this.words.of('flag.off')}` : text
    const sign = PAPER.rim + textWidth(need('flagged') as Element as SVGSVGElement, `${label}\u2002`)
    return { sign, start: sign + (pick.frame?.sign ? PAPER.sign : 0), said }
  }

  private sizeOnPaper(flag: Flag): { width: number; height: number } {
    const { start, said } = this.onPaper(flag)
    return { width: start + textWidth(need('flagged') as Element as SVGSVGElement, said) + PAPER.rim, height: PAPER.height }
  }

  /** The flags as they belong into a picture of the eye's size, for print. */
  drawInto(target: SVGSVGElement): void {
    const { width, pixels } = this.stage.eye
    target.setAttribute('viewBox', `0 0 ${width} ${pixels}`)
    target.replaceChildren()
    for (const { flag, hidden, reached, x, y, inner, start: begin, left, top, width: w, height: h } of this.layout((f) => this.sizeOnPaper(f), RIM)) {
      const { sign, start, said } = this.onPaper(flag)
      const { frame } = flag.pick
      const name = `${hidden ? 'hidden' : ''} ${frame ? `frame ${frame.verdict}` : ''}`
      if (flag.surface) {
        const foot = this.stage.eye.project(flag.surface)
        target.append(svg('line', { class: 'way', x1: x, y1: y, x2: foot.x, y2: foot.y }))
      }
      target.append(
        svg('line', { class: `stub ${name}`, x1: inner, y1: top + h / 2, x2: begin, y2: top + h / 2 }),
        svg('line', { class: `leader ${name}`, x1: begin, y1: top + h / 2, x2: x, y2: y }),
        ...(reached ? [svg('circle', { class: 'anchor', cx: x, cy: y, r: 3.5 })] : []),
        svg('rect', { class: name, x: left, y: top, width: w, height: h, rx: 4 }),
        ...(frame?.sign ? [signOf(frame.sign, { x: left + sign, y: top + h / 2 - 8 })] : []),
        ...(frame ? [svg('text', { class: name, x: left + PAPER.rim, y: top + h / 2 }, flag.label)] : []),
        svg('text', { class: name, x: left + (frame ? start : PAPER.rim), y: top + h / 2 }, frame ? said : `${flag.label}\u2002${said}`),
      )
    }
  }

  private layout(size: (flag: Flag) => { width: number; height: number }, head: number): Placed[] {
    const { eye } = this.stage
    const widest = Math.max(0, ...this.flags.map((flag) => size(flag).width))
    const columns: [Placed[], Placed[]] = [[], []]
    // Heights at which a leader runs in from the other column, to a place beneath this one.
    const crossed: [number[], number[]] = [[], []]
    for (const flag of this.flags) {
      const { place, hidden, reached } = this.stage.endOf(flag.pick)
      const { x, y } = eye.project(place)
      const own = size(flag)
      const within = x >= 0 && x <= eye.width && y >= 0 && y <= eye.pixels
      const near = x < eye.width / 2 ? 0 : 1
      const beneath = within && Math.min(x, eye.width - x) < RIM + widest + GAP
      if (beneath) crossed[near].push(y)
      const side = beneath ? 1 - near : near
      const inner = side === 1 ? eye.width - RIM - own.width : RIM + own.width
      columns[side].push({ flag, hidden, reached, ...own, x, y, inner, start: inner, within, left: side === 1 ? inner : RIM, top: 0 })
    }
    const wide = eye.width >= NARROW
    const kept = columns.map((column, side) => {
      const foot = eye.pixels - (side === 1 && wide ? CUBE : FOOT)
      // The first matter most; the list has them all.
      const some = column.slice(0, Math.max(1, Math.floor((foot - head) / (tallest(column) + GAP))))
      const reach = RIM + Math.max(0, ...some.map((c) => c.width)) + STUB
      for (const c of some) c.start = side === 1 ? eye.width - reach : reach
      stack(some, head, foot, crossed[side])
      return some
    })
    return kept.flat()
  }
}

function write(element: Element, attributes: Record<string, number>): void {
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value.toFixed(1))
}

function tallest(column: Placed[]): number {
  return Math.max(...column.map((c) => c.height), 0)
}

/** Stacks a column between two heights, each flag as near to its place as the others let it, and none where a leader runs. */
function stack(column: Placed[], head: number, foot: number, crossed: number[]): void {
  column.sort((a, b) => a.y - b.y)
  const tall = tallest(column)
  const clear = [...crossed].sort((a, b) => a - b)
  const hit = (top: number) => (y: number) => y > top - LEADER && y < top + tall + LEADER
  let free = head
  for (const c of column) {
    c.top = Math.max(free, c.y - tall / 2)
    for (const y of clear) if (hit(c.top)(y)) c.top = y + LEADER
    free = c.top + tall + GAP
  }
  let limit = foot
  for (const c of [...column].reverse()) {
    c.top = Math.min(c.top, limit - tall)
    for (const y of clear.toReversed()) if (hit(c.top)(y)) c.top = y - LEADER - tall
    limit = c.top - GAP
  }
  uncross(column, (c) => [c.start, c.top + tall / 2])
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
