/** A frame while moving may take this long, milliseconds. */
const FRAME = 33
/** A finer level is tried where a frame takes less than this share of that. */
const EASY = 0.4
/** Milliseconds between two looks at whether a frame is finished. */
const LOOK = 4

/**
 * Follows frames to their end by fences, and chooses the level of detail while the picture moves: the coarsest until its
 * time is known, then step by step the finest that keeps up. Times are those of finished frames: neither the pauses of a
 * hand nor frames that the browser leaves out count, and no name of a GPU does.
 */
export class Pace {
  /** When the last frame was finished. */
  finished = 0
  private at: number | null = null
  /** Levels of this number and below were too slow. */
  private refused = -1
  private slow = 0
  private pending = false
  /** Something was drawn after what is waited for. */
  private more = false

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly idle: () => void,
  ) {}

  /** The level to draw while moving; 0 is everything, `coarsest` the last. */
  level(coarsest: number): number {
    return Math.min(this.at ?? coarsest, coarsest)
  }

  /** What was measured holds no longer: another size, other objects. */
  forget(): void {
    this.at = null
    this.refused = -1
    this.slow = 0
  }

  /** Something that was drawn is not finished. */
  get busy(): boolean {
    return this.pending
  }

  /** Follows what was drawn since `begin` to its end; of a frame of a moving picture the time counts. */
  follow(begin: number, moving: { level: number; coarsest: number } | null): void {
    if (this.pending) {
      this.more = true
      return
    }
    const { gl } = this
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0)
    if (!fence) return
    gl.flush()
    this.pending = true
    const look = () => {
      const state = gl.isContextLost() ? gl.WAIT_FAILED : gl.clientWaitSync(fence, 0, 0)
      if (state === gl.TIMEOUT_EXPIRED) return void setTimeout(look, LOOK)
      gl.deleteSync(fence)
      this.pending = false
      this.finished = performance.now()
      if (moving && state !== gl.WAIT_FAILED) this.took(moving.level, this.finished - begin, moving.coarsest)
      if (this.more) {
        this.more = false
        this.follow(this.finished, null)
      } else this.idle()
    }
    setTimeout(look, LOOK)
  }

  private took(level: number, time: number, coarsest: number): void {
    if (level !== this.level(coarsest)) return
    this.at = level
    this.slow = time > FRAME ? this.slow + 1 : 0
    // One slow frame may be chance, two are not.
    if (this.slow > 1 && level < coarsest) {
      this.refused = Math.max(this.refused, level)
      this.at = level + 1
      this.slow = 0
    } else if (time < FRAME * EASY && level - 1 > this.refused) this.at = level - 1
  }
}
