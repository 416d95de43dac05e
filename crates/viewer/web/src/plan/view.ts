/** What of a drawing is seen: the part of its plane in millimeters, y down as SVG has it. */
export interface Seen {
  x: number
  y: number
  width: number
  height: number
}

/** Pixels that stay free around the whole drawing: for signs with their numbers, and for the ruler at the foot. */
const ROOM = { side: 28, head: 24, foot: 44 }

/** Widest and narrowest that is seen, in widths of the drawing. */
const LIMITS = [1e-6, 20] as const

/** A drawing that can be moved and zoomed. Its signs keep their size on the screen. */
export class PlanView {
  /** What is seen at first. */
  readonly all: Seen
  /** The same with a nominal that is larger by far. */
  private readonly whole: Seen
  private seen: Seen
  /** What is seen as a whole, and the reader has not moved it since. */
  private fitted: Seen | null
  private readonly signs: SVGGElement[]

  constructor(readonly drawing: SVGSVGElement, private readonly changed: () => void) {
    const { x, y, width, height } = drawing.viewBox.baseVal
    this.all = { x, y, width, height }
    const [u, v, w, h] = (drawing.dataset.all ?? '').split(' ').map(Number)
    this.whole = h > 0 ? { x: u, y: v, width: w, height: h } : this.all
    this.seen = { ...this.all }
    this.fitted = this.all
    // The first have their numbers where there is no room for all.
    this.signs = ['.worst', '.join'].flatMap((css) => [...drawing.querySelectorAll<SVGGElement>(css)])
  }

  /** Millimeters of a pixel. The drawing lies in its box as a whole, in the middle. */
  get pixel(): number {
    const box = this.drawing.getBoundingClientRect()
    return Math.max(this.seen.width / Math.max(1, box.width), this.seen.height / Math.max(1, box.height))
  }

  /** The place under a pixel of the page. */
  at(clientX: number, clientY: number): [number, number] {
    const box = this.drawing.getBoundingClientRect()
    const { seen, pixel } = this
    return [
      seen.x + seen.width / 2 + (clientX - box.left - box.width / 2) * pixel,
      seen.y + seen.height / 2 + (clientY - box.top - box.height / 2) * pixel,
    ]
  }

  /** Shows all. */
  fit(all: Seen = this.whole): void {
    const box = this.drawing.getBoundingClientRect()
    const free = { width: Math.max(box.width - 2 * ROOM.side, box.width / 2), height: Math.max(box.height - ROOM.head - ROOM.foot, box.height / 2) }
    // Nothing has a size while it is not shown.
    const pixel = box.width > 0 && box.height > 0 ? Math.max(all.width / free.width, all.height / free.height) : 0
    const down = (pixel * (ROOM.head - ROOM.foot)) / 2
    const [width, height] = [pixel * box.width, pixel * box.height]
    this.look(pixel > 0 ? { x: all.x + (all.width - width) / 2, y: all.y + (all.height - height) / 2 - down, width, height } : all)
    this.fitted = all
  }

  look(seen: Seen): void {
    this.seen = { ...seen }
    this.fitted = null
    this.apply()
  }

  /** The same for paper, whose shape nobody knows before it is printed: no room around the drawing. */
  paper(): void {
    const all = this.fitted
    if (!all) return
    this.look(all)
    this.fitted = all
  }

  /** The drawing has got another size, or has come into sight. */
  resized(): void {
    if (this.fitted) this.fit(this.fitted)
    else this.apply()
  }

  /** Moves the drawing by pixels. */
  pan(dx: number, dy: number): void {
    const { seen, pixel } = this
    this.look({ ...seen, x: seen.x - dx * pixel, y: seen.y - dy * pixel })
  }

  /** Brings the drawing nearer by a factor; the place under the pixel stays. */
  zoom(factor: number, clientX: number, clientY: number): void {
    const { seen, all } = this
    const width = Math.min(LIMITS[1] * all.width, Math.max(LIMITS[0] * all.width, seen.width / factor))
    const by = width / seen.width
    const [x, y] = this.at(clientX, clientY)
    this.look({ x: x + (seen.x - x) * by, y: y + (seen.y - y) * by, width, height: seen.height * by })
  }

  /** Brings a part of the drawing into view, with room around it. */
  show(part: SVGGraphicsElement): void {
    const sign = part.dataset.at?.split(' ').map(Number)
    if (sign) {
      // So near that the interval can be seen.
      const width = Math.min(this.all.width / 12, Math.max(12 * Number(part.dataset.reach), LIMITS[0] * this.all.width))
      const height = (this.all.height * width) / this.all.width
      return this.look({ x: sign[0] - width / 2, y: sign[1] - height / 2, width, height })
    }
    const box = part.getBBox()
    const room = 0.35 * Math.max(box.width, box.height, this.all.width / 1e4)
    this.look({ x: box.x - room, y: box.y - room, width: box.width + 2 * room, height: box.height + 2 * room })
  }

  /** Writes what is seen; signs keep their size, and have their numbers where there is room for them. */
  apply(): void {
    const { x, y, width, height } = this.seen
    this.drawing.setAttribute('viewBox', `${x} ${y} ${width} ${height}`)
    const { pixel } = this
    const taken: [number, number][] = []
    for (const sign of this.signs) {
      const [u, v] = (sign.dataset.at ?? '').split(' ').map(Number)
      sign.setAttribute('transform', `translate(${u} ${v}) scale(${pixel})`)
      const at: [number, number] = [u / pixel, v / pixel]
      const free = taken.every(([a, b]) => Math.abs(a - at[0]) > 20 || Math.abs(b - at[1]) > 16)
      if (free) taken.push(at)
      sign.querySelector('text')?.setAttribute('visibility', free ? 'visible' : 'hidden')
    }
    this.changed()
  }
}
