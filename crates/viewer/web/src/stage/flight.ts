import { Quaternion, Vector3 } from 'three'
import type { Eye } from './eye'

/** Milliseconds from one view to another, and of the flash on arrival. */
const FLIGHT = 320
const FLASH = 700

export interface Goal {
  turn: Quaternion
  target: Vector3
  height: number
}

/** Takes the eye to another view, then lets the place flash once. Without motion, where the reader asked for that. */
export class Flight {
  /** 1 at the height of the flash. */
  pulse = 0
  private frame = 0

  constructor(private readonly changed: () => void) {}

  start(eye: Eye, goal: Goal): void {
    this.stop()
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) {
      eye.turn.copy(goal.turn)
      eye.target.copy(goal.target)
      eye.height = goal.height
      return this.changed()
    }
    const from = { turn: eye.turn.clone(), target: eye.target.clone(), height: eye.height }
    const begin = performance.now()
    const step = () => {
      const past = performance.now() - begin
      const t = Math.min(1, past / FLIGHT)
      const eased = t * t * (3 - 2 * t)
      eye.turn.slerpQuaternions(from.turn, goal.turn, eased)
      eye.target.lerpVectors(from.target, goal.target, eased)
      eye.height = from.height * (goal.height / from.height) ** eased
      const flash = Math.min(1, Math.max(0, past - FLIGHT) / FLASH)
      this.pulse = Math.sin(Math.PI * flash)
      this.frame = flash < 1 ? requestAnimationFrame(step) : 0
      if (flash === 1) this.pulse = 0
      this.changed()
    }
    step()
  }

  stop(): void {
    cancelAnimationFrame(this.frame)
    this.frame = 0
    this.pulse = 0
  }
}
