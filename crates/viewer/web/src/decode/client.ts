import code from 'virtual:worker'
import { blobText, type AnyObject, type LinesEntry } from '../manifest'
import type { PackedLines } from './lines'
import type { DecodedObject, PackedObject } from './object'

/** Starts the worker from the text that the page carries; the page's rules allow no other way. */
function start(): Worker {
  const url = URL.createObjectURL(new Blob([code], { type: 'text/javascript' }))
  const policy = window.trustedTypes?.createPolicy('trueness', { createScriptURL: (text: string) => text })
  return new Worker((policy?.createScriptURL(url) ?? url) as string)
}

/** Decodes all objects, each reported as it is ready. Rejects when one cannot be read. */
export async function decodeAll(objects: AnyObject[], ready: (object: AnyObject, decoded: DecodedObject) => void): Promise<void> {
  const worker = start()
  try {
    for (const object of objects) ready(object, await decodeOne(worker, object))
  } finally {
    worker.terminate()
  }
}

function decodeOne(worker: Worker, object: AnyObject): Promise<DecodedObject> {
  return new Promise((resolve, reject) => {
    worker.onerror = (event) => reject(new Error(event.message))
    worker.onmessage = (event: MessageEvent<{ decoded?: DecodedObject; error?: string }>) =>
      event.data.decoded ? resolve(event.data.decoded) : reject(new Error(event.data.error))
    worker.postMessage({ id: object.id, object: packed(object) })
  })
}

function packed(object: AnyObject): PackedObject {
  const { kind, vertices } = object
  if (object.kind === 'marks') {
    const triangles = object.triangles + object.segments + object.points
    return { kind, vertices, triangles, corners: blobText(object.items.blob), positions: blobText(object.positions.blob), levels: [], fields: [], faces: null }
  }
  return {
    kind,
    vertices,
    triangles: object.triangles ?? 0,
    corners: object.corners ? blobText(object.corners.blob) : null,
    positions: blobText(object.positions.blob),
    levels: object.levels.flatMap((l) => (l.blob !== undefined ? [{ triangles: l.triangles ?? 0, blob: blobText(l.blob) }] : [])),
    faces: object.faces ? { of: blobText(object.faces.of.blob), lines: linesOf(object.faces.lines) } : null,
    fields: object.fields.map((f) => ({ bits: f.bits, step: f.step, blob: blobText(f.blob), reasons: Object.keys(f.no_value).length })),
  }
}

function linesOf({ lines, points, positions, counts }: LinesEntry): PackedLines {
  return { lines, points, positions: blobText(positions.blob), counts: blobText(counts.blob) }
}
