/** `trueness/view/1` as the page carries it. */
export interface Manifest {
  schema: string
  language: string
  decimal: string | null
  up: 'y' | 'z'
  palettes: Record<string, { bands: string; ramp: string; go_no_go: string }>
  quantiles: number[][]
  objects: ViewObject[]
  simplified: boolean
  display_error: number
  result: Result
}

export interface ViewObject {
  id: number
  role: 'measured' | 'reference'
  kind: 'mesh' | 'points'
  name: string
  comparison: number | null
  vertices: number
  source_vertices: number
  triangles?: number
  origin: [number, number, number]
  step: number
  corners?: { blob: number }
  positions: { blob: number }
  levels: { triangles?: number; points?: number; blob?: number; error?: number }[]
  fields: Field[]
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

export interface Worst {
  sign: 1 | -1
  index: number
  point: [number, number, number]
  nearest: [number, number, number]
  deviation: number
}

export interface Comparison {
  reference: string
  deviation: { all: { count: number; mean: number | null; std_dev: number | null; min: number | null; max: number | null } }
  tolerance?: { lower: number; upper: number; inside: number; above: number; below: number }
  histogram: Histogram | null
  worst: Worst[]
}

export interface Result {
  scale: ScaleObject
  comparisons: Comparison[]
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
