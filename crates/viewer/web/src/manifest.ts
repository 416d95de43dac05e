/** `trueness/view/1` as the page carries it. */
export interface Manifest {
  schema: string
  language: string
  decimal: string | null
  up: 'y' | 'z'
  /** Absent on a page that is a drawing. */
  first: FirstView | null
  scale: ScaleObject | null
  /** Keys of the words for what is mapped, and for the high and the low end of the scale. */
  quantity: [string, string, string]
  palettes: Palettes | null
  maps: MapEntry[]
  picks: Pick[]
  objects: AnyObject[]
  simplified: boolean
  display_error: number
}

/** Colors of each palette, hexadecimal. */
export type Palettes = Record<string, { bands: string; ramp: string; go_no_go: string }>

export type AnyObject = ViewObject | MarksObject

interface Entry {
  id: number
  /** What it is to the reader, and the key of its name. */
  role: string
  /** Whether the first view has it. */
  shown: boolean
  vertices: number
  origin: [number, number, number]
  step: number
  positions: { blob: number }
}

export interface ViewObject extends Entry {
  kind: 'mesh' | 'points'
  name: string
  color: string
  comparison: number | null
  source_vertices: number
  /** Set where a place shows the worst measured point near it: how far that can be, millimeters. */
  reach?: number | null
  triangles?: number
  corners?: { blob: number }
  levels: { triangles?: number; points?: number; blob?: number; error?: number }[]
  fields: Field[]
  faces?: FacesEntry
}

/** The faces of a CAD model that a surface draws. */
export interface FacesEntry {
  list: FaceEntry[]
  /** Of each vertex the place of its face in the list. */
  of: { blob: number }
  lines: LinesEntry
}

export interface FaceEntry {
  /** What a user names it by. */
  number: number
  name?: string
  kind: string
  color?: string
}

/** Lines through places on the grid of their object. */
export interface LinesEntry {
  lines: number
  points: number
  positions: { blob: number }
  /** How many places each line has. */
  counts: { blob: number }
}

/** What is drawn over the part: areas, lines and dots, each with the number of its mark. */
export interface MarksObject extends Entry {
  kind: 'marks'
  /** The map that the marks belong to. */
  comparison: number | null
  /** Number of the first mark. */
  first: number
  groups: { key: string; color: string; count: number }[]
  triangles: number
  segments: number
  points: number
  items: { blob: number }
}

export interface Field {
  comparison: number
  bits: number
  step: number
  blob: number
  no_value: Record<string, string>
}

export interface ScaleObject {
  mode: 'bands' | 'continuous' | 'go_no_go'
  lower: number
  upper: number
  tolerance: [number, number] | null
  bands: number
  palette: string
  decimals: number
  unit: string
}

export interface Histogram {
  edges: number[]
  counts: number[]
  below: number
  above: number
}

/** The view that shows most of what matters. */
export interface FirstView {
  /** From the part to the reader. */
  toward: [number, number, number]
  /** Numbers of the picks that it was chosen for, the most important first. */
  places: number[]
}

/** Values that can be shown as colors, with what the scale draws beside them. */
export interface MapEntry {
  name: string
  count: number
  mean: number | null
  tolerance: { lower: number; upper: number; inside: number | null } | null
  histogram: Histogram | null
  /** Least to greatest, evenly spaced; all values where they are as many as `count`. */
  quantiles: number[]
  /** How many values have each color of the scale as the page opens; absent where not all values are at hand. */
  slots: number[] | null
  /** Where maps differ in it: their own scale, the colors of that, and the words as in the manifest. */
  scale: ScaleObject | null
  palettes: Palettes | null
  quantity: [string, string, string] | null
}

/** A place that a row of the list leads to. */
export interface Pick {
  position: [number, number, number]
  /** Places of its feature that the leader of a frame ends at where its own is hidden. */
  others: [number, number, number][]
  /** How many of the first of them show what it says. */
  reached: number
  /** The place of the reference that it was measured from. */
  surface: [number, number, number] | null
  /** That is so far away that the place is not on the part. */
  off: boolean
  /** Half the size of what to bring into view. */
  reach: number | null
  normal: [number, number, number] | null
  mark: number | null
  /** Number of the object that is meant. */
  object: number | null
  map: number | null
  value: number | null
  /** What stands at the end of a leader to the place, where it is no value of a map. */
  frame: Frame | null
}

/** A characteristic as a drawing has it, with what was found. */
export interface Frame {
  /** Its name in the plan and the list. */
  id: string
  /** The sign as the path of an SVG in a square of 16. */
  sign: string | null
  /** The parameter of a texture, in place of a sign. */
  parameter: string | null
  diametral: boolean
  lower: number | null
  upper: number
  /** Behind value and limits: `°`, or nothing. */
  unit: string
  /** Which size, and where the zone of a profile lies, by the letters of drawings. */
  letters: string[]
  /** The letter of a material requirement of the feature. */
  material: string | null
  /** `A`, `A-B`, with a material requirement `A(M)`. */
  datums: string[]
  value: number | null
  decimals: number
  /** Key of the verdict's word, and its class. */
  verdict: string
}

function json<T>(id: string): T {
  const text = document.getElementById(id)?.textContent
  if (!text) throw new Error(`${id} is missing`)
  return JSON.parse(text) as T
}

export const readManifest = () => json<Manifest>('manifest')
export const readTexts = () => json<Record<string, Record<string, string>>>('texts')

/** Base64 text of a blob. */
export function blobText(number: number): string {
  const text = document.getElementById(`blob-${number}`)?.textContent
  if (!text) throw new Error(`blob ${number} is missing`)
  return text
}
