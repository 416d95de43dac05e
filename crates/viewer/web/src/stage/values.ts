import type { Object3D, Scene, WebGLRenderer, WebGLRenderTarget } from 'three'
import type { Eye } from './eye'
import { sized, type Front } from './front'
import type { Part } from './part'
import { OBJECTS } from './shaders'

/** What lies under a pixel. */
export interface Reading {
  value: number
  /** The eye's z there, below 0 before it. */
  depth: number
  /** Number of the object. */
  object: number
  /** The face there, by its place among those of the object; −1 where it has none. */
  face: number
  /** 0, or the number of the reason why there is no value. */
  missing: number
}

/**
 * Values as they are drawn, one reading a CSS pixel: hover, pivot and "is this place hidden" are look-ups.
 * Drawn once after the eye has come to rest, read back without waiting for the GPU.
 */
export class ValueBuffer {
  private target: WebGLRenderTarget | null = null
  private pixels: Float32Array<ArrayBuffer> | null = null
  private generation = 0
  private width = 0
  private height = 0

  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly front: Front,
  ) {}

  get ready(): boolean {
    return this.pixels !== null
  }

  /** Forgets the readings: the picture has changed. */
  clear(): void {
    this.generation++
    this.pixels = null
  }

  /**
   * What one looks through, and `besides`, has no values. Nor have points behind `surfaces`, which stand for the clouds
   * where there are some: one sees such points through the gaps between nearer ones, but means the part.
   */
  async draw(scene: Scene, parts: Part[], eye: Eye, surfaces: Part[] | null, besides: Object3D[]): Promise<void> {
    const generation = ++this.generation
    this.target = sized(this.target, eye)
    const { width, height } = this.target
    if (surfaces) this.front.draw(scene, parts, eye, surfaces, besides)
    const drawn = [...besides, ...parts.map((p) => p.drawn)]
    const before = drawn.map((d) => d.visible)
    for (const d of besides) d.visible = false
    for (const part of parts) {
      part.drawn.visible &&= !part.translucent
      part.drawn.material = part.materials.values
      part.setPoints(eye.millimetresPerPixel, 1)
    }
    this.renderer.setClearColor(0, 0)
    this.renderer.setRenderTarget(this.target)
    this.renderer.clear()
    this.renderer.render(scene, eye.camera)
    this.renderer.setRenderTarget(null)
    this.front.leave(parts)
    for (const part of parts) {
      part.drawn.material = part.materials.picture
      part.setPoints(eye.millimetresPerPixel, this.renderer.getPixelRatio())
    }
    drawn.forEach((d, i) => (d.visible = before[i]))
    const pixels = new Float32Array(4 * width * height)
    await this.renderer.readRenderTargetPixelsAsync(this.target, 0, 0, width, height, pixels)
    if (generation !== this.generation) return
    this.pixels = pixels
    this.width = width
    this.height = height
  }

  /** The reading at a CSS pixel from the top left; `null` off the part or while there is none. */
  at(x: number, y: number): Reading | null {
    const [i, j] = [Math.floor(x), this.height - 1 - Math.floor(y)]
    if (!this.pixels || i < 0 || j < 0 || i >= this.width || j >= this.height) return null
    const p = 4 * (j * this.width + i)
    const number = Math.round(this.pixels[p + 2])
    const [object, face] = [number % OBJECTS, Math.floor(number / OBJECTS) - 1]
    if (object === 0) return null
    return { value: this.pixels[p], depth: this.pixels[p + 1], object: object - 1, face, missing: this.pixels[p + 3] }
  }
}
