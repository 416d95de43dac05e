import { decodeObject, type PackedObject } from './object'

/** Decodes one object a message and hands its buffers over without a copy. */
self.onmessage = async (event: MessageEvent<{ id: number; object: PackedObject }>) => {
  const { id, object } = event.data
  const post = self.postMessage as (message: unknown, transfer?: Transferable[]) => void
  try {
    const decoded = await decodeObject(object)
    post({ id, decoded }, [decoded.packed.buffer, decoded.corners.buffer, ...decoded.fields.map((f) => f.buffer), ...(decoded.edges ? [decoded.edges.ends.buffer] : [])])
  } catch (error) {
    post({ id, error: String(error) })
  }
}
