import { unpack } from './blob'
import { roomOf } from './crowding'
import type { SharpEdges } from './edges'
import { differences } from './planes'

/** Lines through places, as the worker is told of them. */
export interface PackedLines {
  lines: number
  points: number
  positions: string
  counts: string
}

/** Lines along edges that the writer knows, as edges of a surface of this area. */
export async function decodeLines(object: PackedLines, area: number): Promise<SharpEdges> {
  const places = new Uint16Array(4 * object.points)
  const bytes = await unpack(object.positions)
  for (let k = 0; k < 3; k++) {
    const d = differences(bytes, 2 * k * object.points, object.points, 2)
    for (let v = 0, place = 0; v < d.length; v++) places[4 * v + k] = place = place + d[v]
  }
  const counts = differences(await unpack(object.counts), 0, object.lines, 3)
  const ends: number[] = []
  let at = 0
  for (const count of counts) {
    for (let v = at; v + 1 < at + count; v++) ends.push(v, v + 1)
    at += count
  }
  if (at !== object.points) throw new Error('lines have other places')
  const all = Uint32Array.from(ends)
  return { ends: all, places, room: roomOf(places, all), area }
}
