import type { PlanView } from './view'

/** Pixels of a step of the arrow keys. */
const STEP = 40

/**
 * Mouse: a drag moves, the wheel zooms to the cursor, a click chooses. Touch: a finger moves, two pinch and so zoom, a double tap fits.
 * `over` hears of the place under the cursor, null when it leaves; `choose` of what was clicked.
 */
export function control(view: PlanView, over: (place: [number, number] | null) => void, choose: (mark: number) => void): void {
  const { drawing } = view
  const fingers = new Map<number, { x: number; y: number }>()
  let moved = 0
  let lastTap = 0
  drawing.addEventListener('pointerdown', (e) => {
    drawing.setPointerCapture(e.pointerId)
    fingers.set(e.pointerId, { x: e.clientX, y: e.clientY })
    moved = 0
    if (e.pointerType !== 'touch' || fingers.size > 1) return
    if (e.timeStamp - lastTap < 300) view.fit()
    lastTap = e.timeStamp
  })
  drawing.addEventListener('pointermove', (e) => {
    over(view.at(e.clientX, e.clientY))
    const before = fingers.get(e.pointerId)
    if (!before) return
    const now = { x: e.clientX, y: e.clientY }
    const [dx, dy] = [now.x - before.x, now.y - before.y]
    moved += Math.hypot(dx, dy)
    if (fingers.size === 2) {
      const other = [...fingers.entries()].find(([id]) => id !== e.pointerId)?.[1] ?? before
      const apart = (p: { x: number; y: number }) => Math.hypot(p.x - other.x, p.y - other.y)
      view.pan(dx / 2, dy / 2)
      view.zoom(apart(now) / Math.max(1, apart(before)), (now.x + other.x) / 2, (now.y + other.y) / 2)
    } else view.pan(dx, dy)
    fingers.set(e.pointerId, now)
  })
  const release = (e: PointerEvent) => {
    if (fingers.delete(e.pointerId) && e.type === 'pointerup' && moved < 4) choose(markAt(drawing, e.clientX, e.clientY))
  }
  drawing.addEventListener('pointerup', release)
  drawing.addEventListener('pointercancel', release)
  drawing.addEventListener('pointerleave', () => over(null))
  drawing.addEventListener(
    'wheel',
    (e) => {
      e.preventDefault()
      const lines = e.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? e.deltaY / 100 : e.deltaY / 3
      view.zoom(Math.exp(-0.25 * Math.max(-4, Math.min(4, lines))), e.clientX, e.clientY)
    },
    { passive: false },
  )
  drawing.addEventListener('keydown', (e) => {
    const arrow = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[e.key]
    const factor = { '+': 1.25, '=': 1.25, '-': 0.8 }[e.key]
    if (!arrow && !factor) return
    e.preventDefault()
    const box = drawing.getBoundingClientRect()
    if (arrow) view.pan(STEP * arrow[0], STEP * arrow[1])
    if (factor) view.zoom(factor, box.left + box.width / 2, box.top + box.height / 2)
  })
}

/** The number of what lies within some pixels of a place of the page; −1 for nothing. */
function markAt(drawing: SVGSVGElement, x: number, y: number): number {
  for (const reach of [0, 3, 6])
    for (const [dx, dy] of [[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]]) {
      const hit = document.elementFromPoint(x + reach * dx, y + reach * dy)?.closest<SVGElement>('[data-mark]')
      if (hit && drawing.contains(hit)) return Number(hit.dataset.mark)
    }
  return -1
}
