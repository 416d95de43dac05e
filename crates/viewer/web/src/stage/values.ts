import { FloatType, NearestFilter, RGBAFormat, WebGLRenderTarget, type Object3D, type Scene, type WebGLRenderer } from 'three'
import type { Eye } from './eye'
import type { Part } from './part'

/** What lies under a pixel. */
export interface Reading {
  value: number
  /** The eye's z there, below 0 before it. */
  depth: number
  /** Number of the object. */
  object: number
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

  constructor(private readonly renderer: WebGLRenderer) {}

  get ready(): boolean {
    return this.pixels !== null
  }

  /** Forgets the readings: the picture has changed. */
  clear(): void {
    this.generation++
    this.pixels = null
  }

  /** What one looks through, and `besides`, has no values. */
  async draw(scene: Scene, parts: Part[], eye: Eye, besides: Object3D[]): Promise<void> {
    const generation = ++this.generation
    const [width, height] = [Math.max(1, Math.round(eye.width)), Math.max(1, Math.round(eye.pixels))]
    if (!this.target || this.target.width !== width || this.target.height !== height) {
      this.target?.dispose()
      this.target = new WebGLRenderTarget(width, height, { type: FloatType, format: RGBAFormat, minFilter: NearestFilter, magFilter: NearestFilter, depthBuffer: true })
    }
    const hidden = [...besides, ...parts.filter((p) => p.translucent).map((p) => p.drawn)].filter((d) => d.visible)
    for (const drawn of hidden) drawn.visible = false
    for (const part of parts) part.drawn.material = part.materials.values
    this.renderer.setRenderTarget(this.target)
    this.renderer.setClearColor(0, 0)
    this.renderer.clear()
    this.renderer.render(scene, eye.camera)
    this.renderer.setRenderTarget(null)
    for (const part of parts) part.drawn.material = part.materials.picture
    for (const drawn of hidden) drawn.visible = true
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
    const object = Math.round(this.pixels[p + 2])
    if (object === 0) return null
    return { value: this.pixels[p], depth: this.pixels[p + 1], object: object - 1, missing: this.pixels[p + 3] }
  }
}
