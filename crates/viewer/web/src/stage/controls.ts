import { Vector3 } from 'three'
import type { Stage } from './stage'

/** Radians a pixel. */
const TURN = 0.008
const STEP = (15 * Math.PI) / 180

/**
 * Mouse: left turns about the point under the cursor, middle or right moves, the wheel zooms to the cursor.
 * Touch: one finger turns, two move, pinch and so zoom; a double tap fits.
 */
export function control(stage: Stage): void {
  const { canvas, eye } = stage
  const fingers = new Map<number, { x: number; y: number }>()
  let pivot = new Vector3()
  let lastTap = 0

  const at = (e: PointerEvent | WheelEvent) => {
    const box = canvas.getBoundingClientRect()
    return { x: e.clientX - box.left, y: e.clientY - box.top }
  }
  /** The place under a pixel; off the part, the middle of the stage. */
  const grasp = (x: number, y: number) => {
    const reading = stage.values.at(x, y)
    return reading ? eye.unproject(x, y, reading.depth) : eye.target.clone()
  }

  canvas.addEventListener('contextmenu', (e) => e.preventDefault())
  canvas.addEventListener('pointerdown', (e) => {
    canvas.setPointerCapture(e.pointerId)
    const p = at(e)
    fingers.set(e.pointerId, p)
    if (fingers.size === 1) pivot = grasp(p.x, p.y)
    if (e.pointerType === 'touch' && fingers.size === 1) {
      if (e.timeStamp - lastTap < 300) stage.fit()
      lastTap = e.timeStamp
    }
  })
  canvas.addEventListener('pointermove', (e) => {
    const before = fingers.get(e.pointerId)
    if (!before) return
    const now = at(e)
    const [dx, dy] = [now.x - before.x, now.y - before.y]
    if (fingers.size === 2) {
      const other = [...fingers.entries()].find(([id]) => id !== e.pointerId)?.[1] ?? before
      const apart = (p: { x: number; y: number }) => Math.hypot(p.x - other.x, p.y - other.y)
      eye.pan(dx / 2, dy / 2)
      eye.zoom(apart(now) / Math.max(1, apart(before)), (now.x + other.x) / 2, (now.y + other.y) / 2)
    } else if (e.buttons & 6 || (e.buttons & 1 && e.shiftKey)) eye.pan(dx, dy)
    else eye.orbit(-dx * TURN, -dy * TURN, pivot)
    fingers.set(e.pointerId, now)
    stage.moved()
  })
  const release = (e: PointerEvent) => fingers.delete(e.pointerId)
  canvas.addEventListener('pointerup', release)
  canvas.addEventListener('pointercancel', release)
  canvas.addEventListener(
    'wheel',
    (e) => {
      e.preventDefault()
      const p = at(e)
      const lines = e.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? e.deltaY / 100 : e.deltaY / 3
      eye.zoom(Math.exp(-0.25 * Math.max(-4, Math.min(4, lines))), p.x, p.y)
      stage.moved()
    },
    { passive: false },
  )
  canvas.addEventListener('keydown', (e) => {
    if (move(stage, e)) {
      e.preventDefault()
      stage.moved()
    }
  })
}

/** Arrow keys turn (Shift: move, Ctrl: by one degree), plus and minus zoom. */
function move(stage: Stage, e: KeyboardEvent): boolean {
  const { eye } = stage
  const arrows: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }
  const arrow = arrows[e.key]
  if (arrow && e.shiftKey) eye.pan(40 * arrow[0], 40 * arrow[1])
  else if (arrow) {
    const step = e.ctrlKey ? STEP / 15 : STEP
    eye.orbit(arrow[0] * step, arrow[1] * step, eye.target.clone())
  } else if (e.key === '+' || e.key === '=') eye.zoom(1.25, eye.width / 2, eye.pixels / 2)
  else if (e.key === '-') eye.zoom(0.8, eye.width / 2, eye.pixels / 2)
  else return false
  return true
}
