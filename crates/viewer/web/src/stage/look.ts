import { DataTexture, GLSL3, NearestFilter, RawShaderMaterial, RGBAFormat, UnsignedByteType, Vector2, Vector3, type IUniform } from 'three'
import type { FacesEntry, ViewObject } from '../manifest'
import { parse, type Rgb } from '../scale/scale'
import type { State } from '../state'
import { FACE_COLUMNS, FRAGMENT, VALUES, VERTEX } from './shaders'

/** Opacity of what is looked through, by role. */
const OPACITIES: Record<string, number> = { element: 0.28 }
const MOST_LIMITS = 34

const slots = texture(36)
const ramp = texture(256)

/** The model's color of each face; clear where it gives none. */
function colorsOf({ list }: FacesEntry): DataTexture {
  const t = texture(FACE_COLUMNS, Math.max(1, Math.ceil(list.length / FACE_COLUMNS)))
  list.forEach(({ color }, i) => color && (t.image.data as Uint8Array).set([...parse(color)[0], 255], 4 * i))
  t.needsUpdate = true
  return t
}

/** What all objects are colored by: changing it costs one frame and touches no vertex. */
const shared: Record<string, IUniform> = {
  flatColors: { value: false },
  perspective: { value: false },
  backfaces: { value: false },
  continuous: { value: false },
  hatch: { value: false },
  limits: { value: new Float32Array(MOST_LIMITS) },
  limitCount: { value: 0 },
  range: { value: new Vector2() },
  zone: { value: new Vector2() },
  only: { value: new Vector2() },
  slots: { value: slots },
  ramp: { value: ramp },
  asCover: { value: false },
  modelColors: { value: false },
}

function texture(width: number, height = 1): DataTexture {
  const t = new DataTexture(new Uint8Array(4 * width * height), width, height, RGBAFormat, UnsignedByteType)
  t.magFilter = t.minFilter = NearestFilter
  return t
}

function paint(t: DataTexture, colors: Rgb[]): void {
  const data = t.image.data as Uint8Array
  colors.forEach((c, i) => data.set([...c, 255], 4 * i))
  t.needsUpdate = true
}

/** Takes over scale and switches from the state. */
export function applyLook(state: State): void {
  const { scale, colors, only } = state
  const limits = colors.limits.slice(0, MOST_LIMITS)
  shared.limits.value.fill(0)
  shared.limits.value.set(limits)
  shared.limitCount.value = limits.length
  shared.range.value.set(scale.lower, scale.upper)
  // Without a tolerance: empty.
  shared.zone.value.set(...(scale.tolerance ?? [1, -1]))
  shared.only.value.set(only ? only[0] : -3e38, only ? only[1] : 3e38)
  shared.continuous.value = scale.mode === 'continuous'
  shared.hatch.value = scale.palette === 'mono'
  shared.flatColors.value = state.flat
  shared.perspective.value = state.perspective
  shared.backfaces.value = state.backfaces
  shared.modelColors.value = state.modelColors
  paint(slots, colors.slots)
  paint(ramp, colors.ramp)
}

/** What is drawn next is to hide other things, and has no values. */
export function asCover(on: boolean): void {
  shared.asCover.value = on
}

export interface Materials {
  picture: RawShaderMaterial
  values: RawShaderMaterial
  /** Uniforms of this object alone. */
  own: Record<'map' | 'slack' | 'pointSize' | 'lift' | 'rise' | 'opacity' | 'back' | 'sink' | 'cover' | 'covered' | 'near', IUniform>
}

export function materialsFor(object: ViewObject): Materials {
  const [base] = parse(object.color)
  const opacity = OPACITIES[object.role] ?? 1
  const own = {
    map: { value: true },
    slack: { value: 0 },
    pointSize: { value: 3 },
    lift: { value: 0 },
    rise: { value: 0 },
    opacity: { value: opacity },
    back: { value: false },
    sink: { value: 0 },
    cover: { value: null },
    covered: { value: false },
    near: { value: 0 },
  }
  const uniforms = {
    ...shared,
    ...own,
    base: { value: new Vector3(...base.map((x) => x / 255)) },
    objectId: { value: object.id + 1 },
    ...(object.faces ? { faceColors: { value: colorsOf(object.faces) } } : {}),
  }
  const make = (fragmentShader: string) =>
    new RawShaderMaterial({
      glslVersion: GLSL3,
      defines: object.kind === 'points' ? { POINTS: '' } : object.faces ? { FACES: '' } : {},
      vertexShader: VERTEX,
      fragmentShader,
      uniforms,
      side: 2,
      transparent: opacity < 1,
      depthWrite: opacity === 1,
      // Points on a surface stay in front of it.
      polygonOffset: object.kind === 'mesh',
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    })
  return { picture: make(FRAGMENT), values: make(VALUES), own }
}
