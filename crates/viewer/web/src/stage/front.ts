import { FloatType, NearestFilter, RGBAFormat, WebGLRenderTarget, type Object3D, type Scene, type WebGLRenderer } from 'three'
import type { Eye } from './eye'
import { asCover } from './look'
import type { Part } from './part'
import { NEAR } from './sight'

/** Numbers for each CSS pixel; one that is there is kept while its size fits. */
export function sized(target: WebGLRenderTarget | null, eye: Eye): WebGLRenderTarget {
  const [width, height] = [Math.max(1, Math.round(eye.width)), Math.max(1, Math.round(eye.pixels))]
  if (target?.width === width && target.height === height) return target
  target?.dispose()
  return new WebGLRenderTarget(width, height, { type: FloatType, format: RGBAFormat, minFilter: NearestFilter, magFilter: NearestFilter, depthBuffer: true })
}

/** The surfaces that hide points of clouds, as the eye sees them: which points lie on them and which behind is told by that. */
export class Front {
  private target: WebGLRenderTarget | null = null

  constructor(private readonly renderer: WebGLRenderer) {}

  /** Draws `surfaces` alone, and gives them to the parts with values until [`leave`] takes them back. */
  draw(scene: Scene, parts: Part[], eye: Eye, surfaces: Part[], besides: Object3D[]): void {
    this.target = sized(this.target, eye)
    const drawn = [...besides, ...parts.map((p) => p.drawn)]
    const before = drawn.map((d) => d.visible)
    for (const d of besides) d.visible = false
    for (const part of parts) {
      part.drawn.visible = !part.translucent && surfaces.includes(part)
      part.drawn.material = part.materials.values
      part.setPoints(eye.millimetresPerPixel, 1, true)
    }
    asCover(true)
    this.renderer.setClearColor(0, 0)
    this.renderer.setRenderTarget(this.target)
    this.renderer.clear()
    this.renderer.render(scene, eye.camera)
    this.renderer.setRenderTarget(null)
    asCover(false)
    for (const part of parts) part.drawn.material = part.materials.picture
    drawn.forEach((d, i) => (d.visible = before[i]))
    const own = Math.max(0, ...surfaces.map((p) => p.depth))
    for (const part of parts) if (part.hasMap || surfaces.includes(part)) part.setCover(this.target.texture, NEAR * eye.size + own)
  }

  leave(parts: Part[]): void {
    for (const part of parts) part.setCover(null, 0)
  }
}
