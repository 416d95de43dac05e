/** How long the edges are that are seen, each by its share, for any room that they need. */
export class Crowd {
  /** Rooms in ascending order, and the sums of lengths and of lengths times squared rooms up to each. */
  private readonly rooms: Float64Array
  private readonly lengths: Float64Array
  private readonly squares: Float64Array

  constructor(room: Float32Array, lengths: Float32Array) {
    const order = Uint32Array.from(room, (_, i) => i).sort((a, b) => room[a] - room[b])
    this.rooms = Float64Array.from(order, (i) => room[i])
    this.lengths = new Float64Array(room.length + 1)
    this.squares = new Float64Array(room.length + 1)
    order.forEach((i, n) => {
      this.lengths[n + 1] = this.lengths[n] + lengths[i]
      this.squares[n + 1] = this.squares[n] + lengths[i] * room[i] ** 2
    })
  }

  /** Edges with at least this room are seen in full, others by the square of their share of it. */
  seen(needed: number): number {
    let [low, high] = [0, this.rooms.length]
    while (low < high) {
      const middle = (low + high) >> 1
      if (this.rooms[middle] < needed) low = middle + 1
      else high = middle
    }
    return this.lengths[this.rooms.length] - this.lengths[low] + this.squares[low] / needed ** 2
  }
}
