import { FloatType, NearestFilter, RGBAFormat, WebGLRenderTarget, type Object3D, type Scene, type WebGLRenderer } from 'three'
import type { Eye } from './eye'
import type { Part } from './part'
import { NEAR } from './sight'

function sized(target: WebGLRenderTarget | null, width: number, height: number): WebGLRenderTarget {
  if (target?.width === width && target.height === height) return target
  target?.dispose()
  return new WebGLRenderTarget(width, height, { type: FloatType, format: RGBAFormat, minFilter: NearestFilter, magFilter: NearestFilter, depthBuffer: true })
}

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
  private cover: WebGLRenderTarget | null = null
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

  /**
   * What one looks through, and `besides`, has no values. Nor have points behind `surfaces`, which stand for the clouds
   * where there are some: one sees such points through the gaps between nearer ones, but means the part.
   */
  async draw(scene: Scene, parts: Part[], eye: Eye, surfaces: Part[] | null, besides: Object3D[]): Promise<void> {
    const generation = ++this.generation
    const [width, height] = [Math.max(1, Math.round(eye.width)), Math.max(1, Math.round(eye.pixels))]
    this.target = sized(this.target, width, height)
    const drawn = [...besides, ...parts.map((p) => p.drawn)]
    const before = drawn.map((d) => d.visible)
    const show = (wanted: (part: Part, visible: boolean) => boolean) => {
      for (const d of besides) d.visible = false
      parts.forEach((part, i) => (part.drawn.visible = !part.translucent && wanted(part, before[besides.length + i])))
    }
    const render = (target: WebGLRenderTarget) => {
      this.renderer.setRenderTarget(target)
      this.renderer.clear()
      this.renderer.render(scene, eye.camera)
    }
    for (const part of parts) part.drawn.material = part.materials.values
    this.renderer.setClearColor(0, 0)
    if (surfaces) {
      this.cover = sized(this.cover, width, height)
      for (const part of parts) part.setPoints(eye.millimetresPerPixel, 1, true)
      show((part) => surfaces.includes(part))
      render(this.cover)
      const own = Math.max(0, ...surfaces.map((p) => p.depth))
      for (const part of parts) if (part.hasMap || surfaces.includes(part)) part.setCover(this.cover.texture, NEAR * eye.size + own)
    }
    for (const part of parts) part.setPoints(eye.millimetresPerPixel, 1)
    show((_, visible) => visible)
    render(this.target)
    this.renderer.setRenderTarget(null)
    for (const part of parts) {
      part.drawn.material = part.materials.picture
      part.setCover(null, 0)
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
    const object = Math.round(this.pixels[p + 2])
    if (object === 0) return null
    return { value: this.pixels[p], depth: this.pixels[p + 1], object: object - 1, missing: this.pixels[p + 3] }
  }
}
