import { OrthographicCamera, PerspectiveCamera, Quaternion, Vector3, Matrix4 } from 'three'

/** Half of the perspective's opening angle. */
const HALF_ANGLE = (15 * Math.PI) / 180
/** Share of the free area's smaller side that the part fills after "fit". */
const FILL = 0.86

export const STANDARD = ['front', 'back', 'left', 'right', 'top', 'bottom', 'iso'] as const
export type StandardView = (typeof STANDARD)[number]

/** Cosine of the angle beyond which a surface is too oblique to be seen well. */
const SEEN = 0.35

/** Looks back along `toward`, with `up` upright. */
function facing(toward: Vector3, up: Vector3): Quaternion {
  const t = toward.clone().normalize()
  const r = up.clone().cross(t).normalize()
  return new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(r, t.clone().cross(r), t))
}

/** Where the reader looks from. Places are relative to the stage's center, in millimeters. */
export class Eye {
  /** From the eye's axes (right, up, toward the reader) to the model's. */
  readonly turn = new Quaternion()
  /** Place in the middle of the stage. */
  readonly target = new Vector3()
  /** Millimeters from the stage's foot to its top. */
  height = 1
  perspective = false
  width = 1
  pixels = 1
  private radius = 1
  private readonly flat = new OrthographicCamera()
  private readonly deep = new PerspectiveCamera((2 * HALF_ANGLE * 180) / Math.PI)

  constructor(private readonly up: 'y' | 'z') {
    this.look('iso')
  }

  /** The radius around the stage's center that everything lies in. */
  setRadius(radius: number): void {
    this.radius = radius
  }

  /** Of everything, millimeters. */
  get size(): number {
    return 2 * this.radius
  }

  /** The three.js camera for this moment. */
  get camera(): OrthographicCamera | PerspectiveCamera {
    const camera = this.perspective ? this.deep : this.flat
    const distance = this.distance
    camera.quaternion.copy(this.turn)
    camera.position.copy(this.toward.multiplyScalar(distance).add(this.target))
    const reach = this.radius + this.target.length()
    camera.near = this.perspective ? Math.max(distance - reach, distance / 1000) : distance - reach
    camera.far = distance + reach
    if (camera === this.flat) {
      const h = this.height / 2
      Object.assign(camera, { left: -h * this.aspect, right: h * this.aspect, top: h, bottom: -h })
    } else this.deep.aspect = this.aspect
    camera.updateProjectionMatrix()
    camera.updateMatrixWorld()
    return camera
  }

  private get aspect(): number {
    return this.width / this.pixels
  }

  private get distance(): number {
    return this.perspective ? this.height / (2 * Math.tan(HALF_ANGLE)) : 2 * this.radius + this.target.length()
  }

  get toward(): Vector3 {
    return new Vector3(0, 0, 1).applyQuaternion(this.turn)
  }

  get right(): Vector3 {
    return new Vector3(1, 0, 0).applyQuaternion(this.turn)
  }

  get upward(): Vector3 {
    return new Vector3(0, 1, 0).applyQuaternion(this.turn)
  }

  /** The model's axis that points up in the standard views. */
  get vertical(): Vector3 {
    return this.up === 'y' ? new Vector3(0, 1, 0) : new Vector3(0, 0, 1)
  }

  /** Orientation of a standard view. */
  orientation(view: StandardView): Quaternion {
    const x = new Vector3(1, 0, 0)
    const u = this.vertical
    const f = this.up === 'y' ? new Vector3(0, 0, 1) : new Vector3(0, -1, 0)
    const back = f.clone().negate()
    const of = facing
    switch (view) {
      case 'front':
        return of(f, u)
      case 'back':
        return of(back, u)
      case 'left':
        return of(x.clone().negate(), u)
      case 'right':
        return of(x, u)
      case 'top':
        return of(u, back)
      case 'bottom':
        return of(u.clone().negate(), f)
      case 'iso':
        return of(x.clone().add(f).add(u), u)
    }
  }

  /** The orientation that shows a surface which looks along `normal`: the present one where it does, else obliquely from above. */
  showing(normal: Vector3): Quaternion {
    if (this.toward.dot(normal) > SEEN) return this.turn.clone()
    const up = this.vertical
    const across = new Vector3(up.y, up.z, up.x)
    const toward = normal.clone().multiplyScalar(1.6).add(up).addScaledVector(across, 0.4).normalize()
    return facing(toward, Math.abs(toward.dot(up)) > 0.99 ? across : up)
  }

  look(view: StandardView): void {
    this.turn.copy(this.orientation(view))
  }

  /** Looks from a side of the part, the model's vertical upright. */
  lookFrom(toward: Vector3): void {
    this.turn.copy(facing(toward, this.vertical))
  }

  /** Turns by angles about the model's vertical and the screen's horizontal axis, the place `pivot` staying where it is. */
  orbit(aboutVertical: number, aboutRight: number, pivot: Vector3): void {
    const upright = this.upward.dot(this.vertical) < 0 ? -1 : 1
    const turn = new Quaternion().setFromAxisAngle(this.vertical, aboutVertical * upright)
    turn.multiply(new Quaternion().setFromAxisAngle(this.right, aboutRight))
    this.turn.premultiply(turn).normalize()
    this.target.sub(pivot).applyQuaternion(turn).add(pivot)
  }

  /** Moves the picture by pixels. */
  pan(dx: number, dy: number): void {
    const scale = this.millimetresPerPixel
    this.target.addScaledVector(this.right, -dx * scale).addScaledVector(this.upward, dy * scale)
  }

  /** Zooms by a factor (above 1: nearer), the point under the pixel staying where it is. */
  zoom(factor: number, x: number, y: number): void {
    const before = this.millimetresPerPixel
    this.height = Math.min(Math.max(this.height / factor, this.radius * 1e-5), this.radius * 100)
    const change = before - this.millimetresPerPixel
    this.target.addScaledVector(this.right, (x - this.width / 2) * change).addScaledVector(this.upward, (this.pixels / 2 - y) * change)
  }

  get millimetresPerPixel(): number {
    return this.height / this.pixels
  }

  /** Frames places within the stage, leaving `margin` pixels free on the left and on the right, and `head` above. */
  fit(places: Vector3[], margin: number, head: number): void {
    if (places.length === 0) return
    const span = (axis: Vector3) => {
      let [least, most] = [Infinity, -Infinity]
      for (const place of places) {
        const along = place.dot(axis)
        least = Math.min(least, along)
        most = Math.max(most, along)
      }
      return [least, most]
    }
    const [l, r] = span(this.right)
    const [b, t] = span(this.upward)
    const [n, f] = span(this.toward)
    this.target
      .set(0, 0, 0)
      .addScaledVector(this.right, (l + r) / 2)
      .addScaledVector(this.upward, (b + t) / 2)
      .addScaledVector(this.toward, (n + f) / 2)
    const free = Math.max(this.width - 2 * margin, this.width / 3)
    const scale = Math.max((r - l) / free, (t - b) / (this.pixels - head), 1e-9) / FILL
    this.height = scale * this.pixels
    this.target.addScaledVector(this.upward, (scale * head) / 2)
    if (this.perspective) this.height *= 1 + (f - n) / (4 * this.height)
  }

  /** Pixel of a place. `behind`: on the far side of the eye. */
  project(place: Vector3): { x: number; y: number; depth: number; behind: boolean } {
    const camera = this.camera
    const seen = place.clone().applyMatrix4(camera.matrixWorldInverse)
    const p = place.clone().project(camera)
    return { x: ((p.x + 1) / 2) * this.width, y: ((1 - p.y) / 2) * this.pixels, depth: seen.z, behind: seen.z > 0 }
  }

  /** How much larger things at a depth (the eye's z, below 0 before it) are drawn than in the middle of the stage. */
  growth(depth: number): number {
    return this.perspective ? -this.distance / depth : 1
  }

  /** Place at a pixel and a depth (the eye's z, below 0 before it). */
  unproject(x: number, y: number, depth: number): Vector3 {
    const camera = this.camera
    const growth = this.growth(depth)
    const u = (((x / this.width) * 2 - 1) * (this.height / 2) * this.aspect) / growth
    const v = ((1 - (y / this.pixels) * 2) * (this.height / 2)) / growth
    return new Vector3(u, v, depth).applyMatrix4(camera.matrixWorld)
  }

  save(): number[] {
    return [...this.turn.toArray(), ...this.target.toArray(), this.height].map((x) => Number(x.toPrecision(7)))
  }

  restore(numbers: number[]): void {
    if (numbers.length !== 8 || !numbers.every(Number.isFinite) || numbers[7] <= 0) return
    this.turn.fromArray(numbers).normalize()
    this.target.fromArray(numbers, 4)
    this.height = numbers[7]
  }
}
