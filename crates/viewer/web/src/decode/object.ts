import { unpack } from './blob'
import { packCloudNormals } from './cloud_normals'
import { areaOf, sharpEdges, type SharpEdges } from './edges'
import { decodeLines, type PackedLines } from './lines'
import { packNormals } from './normals'
import { differences, wrapSigned } from './planes'
import { ACROSS, BETWEEN, LIKE, rules } from './predict'
import { decodeTriangles } from './triangles'

/** What the worker is told about an object: its manifest entry's numbers, and its blobs as text. */
export interface PackedObject {
  kind: 'mesh' | 'points' | 'marks'
  vertices: number
  /** Of marks: areas, lines and dots together. */
  triangles: number
  /** Of marks: the number of the mark that each area, line and dot is of. */
  corners: string | null
  positions: string
  levels: { triangles: number; blob: string }[]
  fields: { bits: number; step: number; blob: string; reasons: number }[]
  /** Of a mesh of faces: the face of each vertex, and lines along edges. */
  faces: { of: string; lines: PackedLines } | null
}

/** What it answers: buffers that go to the GPU as they are. */
export interface DecodedObject {
  /** Four numbers a vertex: x, y, z on the grid, and the packed normal (0 for marks). */
  packed: Uint16Array
  /** Corners of the full level, then of each coarser one. Empty for points; the numbers of marks. */
  corners: Uint32Array
  /** One array a field, in millimeters; from 1e30 upwards: no value, for reason value / 1e30 − 1. */
  fields: Float32Array[]
  /** Of a mesh. */
  edges: SharpEdges | null
  /** Of a mesh of faces, that of each vertex. */
  faces: Float32Array | null
}

/** Values from here on are reasons why there is none. */
export const NO_VALUE = 1e30

export async function decodeObject(object: PackedObject): Promise<DecodedObject> {
  if (object.kind === 'mesh') return decodeMesh(object)
  const points = await decodePoints(object)
  if (object.kind === 'points') {
    packCloudNormals(points.packed)
    return points
  }
  const steps = differences(await unpack(object.corners ?? ''), 0, object.triangles, 3)
  let number = 0
  return { ...points, corners: Uint32Array.from(steps, (step) => (number += wrapSigned(step, 3))) }
}

async function decodeMesh(object: PackedObject): Promise<DecodedObject> {
  const total = object.levels.reduce((n, level) => n + level.triangles, object.triangles)
  const corners = new Uint32Array(3 * total)
  const full = corners.subarray(0, 3 * object.triangles)
  decodeTriangles(await unpack(object.corners ?? ''), full)
  const rule = rules(full, object.vertices)
  const packed = new Uint16Array(4 * object.vertices)
  const bytes = await unpack(object.positions)
  for (let k = 0; k < 3; k++) {
    const d = differences(bytes, 2 * k * object.vertices, object.vertices, 2)
    for (let v = 0; v < d.length; v++) packed[4 * v + k] = predictPlace(rule, packed, v, k) + d[v]
  }
  packNormals(packed, full)
  let at = full.length
  for (const level of object.levels) {
    decodeTriangles(await unpack(level.blob), corners.subarray(at, at + 3 * level.triangles))
    at += 3 * level.triangles
  }
  for (let i = 0; i < corners.length; i++) if (corners[i] >= object.vertices) throw new Error('a triangle has no such vertex')
  const fields = []
  for (const field of object.fields) fields.push(await decodeField(field, object.vertices, (codes, v) => predictValue(rule, codes, v)))
  if (!object.faces) return { packed, corners, fields, edges: sharpEdges(packed, full), faces: null }
  const edges = await decodeLines(object.faces.lines, areaOf(packed, full))
  const codes = await decodeCodes(object.faces.of, object.vertices, 3, (codes, v) => predictValue(rule, codes, v))
  return { packed, corners, fields, edges, faces: Float32Array.from(codes) }
}

async function decodePoints(object: PackedObject): Promise<DecodedObject> {
  const packed = new Uint16Array(4 * object.vertices)
  const bytes = await unpack(object.positions)
  for (let k = 0; k < 3; k++) {
    const d = differences(bytes, 2 * k * object.vertices, object.vertices, 2)
    for (let v = 0, place = 0; v < d.length; v++) packed[4 * v + k] = place = place + d[v]
  }
  const fields = []
  for (const field of object.fields) fields.push(await decodeField(field, object.vertices, (codes, v) => (v > 0 ? codes[v - 1] : 0)))
  return { packed, corners: new Uint32Array(0), fields, edges: null, faces: null }
}

function predictPlace(rule: Uint32Array, packed: Uint16Array, v: number, k: number): number {
  const at = 4 * v
  const a = packed[4 * rule[at + 1] + k]
  switch (rule[at]) {
    case ACROSS:
      return a + packed[4 * rule[at + 2] + k] - packed[4 * rule[at + 3] + k]
    case BETWEEN:
      return (a + packed[4 * rule[at + 2] + k]) >> 1
    case LIKE:
      return a
    default:
      return 0
  }
}

function predictValue(rule: Uint32Array, codes: Int32Array, v: number): number {
  const at = 4 * v
  switch (rule[at]) {
    case ACROSS:
    case BETWEEN:
      return (codes[rule[at + 1]] + codes[rule[at + 2]]) >> 1
    case LIKE:
      return codes[rule[at + 1]]
    default:
      return 0
  }
}

async function decodeField(
  field: PackedObject['fields'][number],
  count: number,
  predict: (codes: Int32Array, v: number) => number,
): Promise<Float32Array> {
  const codes = await decodeCodes(field.blob, count, field.bits / 8, predict)
  const values = new Float32Array(count)
  const lowest = -(2 ** (field.bits - 1))
  for (let v = 0; v < count; v++) {
    const reason = codes[v] - lowest
    values[v] = reason < field.reasons ? NO_VALUE * (1 + reason) : codes[v] * field.step
  }
  return values
}

/** Whole numbers out of their differences from the prediction. */
async function decodeCodes(blob: string, count: number, width: number, predict: (codes: Int32Array, v: number) => number): Promise<Int32Array> {
  const codes = differences(await unpack(blob), 0, count, width)
  for (let v = 0; v < count; v++) codes[v] = wrapSigned(predict(codes, v) + codes[v], width)
  return codes
}
