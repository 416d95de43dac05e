import { el, need } from '../dom'
import type { FaceEntry } from '../manifest'
import type { State } from '../state'
import type { Words } from '../words'
import type { Part } from './part'
import type { Stage } from './stage'

/** What lies under the cursor: beside it, on the scale, and in the status line. */
export function hover(stage: Stage, overlay: HTMLElement, state: State, words: Words): void {
  const card = el('div', { class: 'hover', role: 'status', hidden: true })
  const dot = el('div', { class: 'dot', hidden: true })
  overlay.append(dot, card)
  const line = need('readout')
  let cursor: { x: number; y: number } | null = null

  const clear = () => {
    card.hidden = dot.hidden = true
    line.textContent = ''
    state.setHover(null)
  }
  const read = () => {
    if (!cursor) return clear()
    const drawn = stage.values.at(cursor.x, cursor.y)
    if (!drawn) {
      clear()
      if (!stage.values.ready) line.textContent = '…'
      return
    }
    const part = stage.part(drawn.object)
    const place = stage.eye.unproject(cursor.x, cursor.y, drawn.depth).add(stage.center)
    const reading = drawn.missing === 0 ? { ...drawn, value: part?.pointNear(place) ?? drawn.value } : drawn
    const xyz = place.toArray().map((x) => words.number(x, 2))
    const valued = part?.hasMap === true && reading.missing === 0
    const decimals = digits(part?.step ?? 0, state.scale.decimals)
    const value = valued ? `${words.onScale(reading.value, state.scale, decimals)} ${state.scale.unit}` : part?.hasMap ? words.of('no_value') : ''
    const why = part?.hasMap && reading.missing > 0 ? words.of(`reason.${part.reason(reading.missing)}`) : ''
    const zone = state.scale.tolerance
    const inside = zone && reading.value >= zone[0] - part!.step / 2 && reading.value <= zone[1] + part!.step / 2
    const judged = valued && zone ? (inside ? `✓ ${words.of('state.in')}` : `✕ ${words.of('state.out')}`) : ''
    const several = part ? state.manifest.objects.filter((o) => o.role === part.object.role).length > 1 : false
    const role = part ? what(part, valued, several, words) : ''
    const face = nameOf(part?.object.faces?.list[reading.face], words)
    card.replaceChildren(
      ...(value ? [el('strong', {}, value)] : []),
      ...(judged || why ? [el('span', { class: inside ? 'in' : 'out' }, judged || why)] : []),
      el('span', { class: 'place' }, `x ${xyz[0]}  y ${xyz[1]}  z ${xyz[2]}`),
      el('span', { class: 'place' }, role),
      ...(face ? [el('span', { class: 'place' }, face)] : []),
    )
    line.textContent = [value, judged || why, role, face, `x ${xyz[0]} y ${xyz[1]} z ${xyz[2]}`].filter(Boolean).join(' · ')
    line.dataset.value = valued ? String(reading.value) : ''
    dot.hidden = card.hidden = false
    dot.style.transform = `translate(${cursor.x}px, ${cursor.y}px)`
    const left = cursor.x > stage.eye.width - 220 ? cursor.x - 16 - card.offsetWidth : cursor.x + 16
    const top = cursor.y > stage.eye.pixels - 110 ? cursor.y - 12 - card.offsetHeight : cursor.y + 12
    card.style.transform = `translate(${left}px, ${top}px)`
    state.setHover(valued ? reading.value : null)
  }
  stage.canvas.addEventListener('pointermove', (e) => {
    const box = stage.canvas.getBoundingClientRect()
    cursor = e.buttons ? null : { x: e.clientX - box.left, y: e.clientY - box.top }
    read()
  })
  stage.canvas.addEventListener('pointerleave', () => {
    cursor = null
    clear()
  })
  stage.onDraw(read)
}

/** What is told of a face: its number, its name, what it is. */
function nameOf(face: FaceEntry | undefined, words: Words): string {
  if (!face) return ''
  return [`${words.of('hover.face')} ${face.number}`, face.name ?? '', words.of(`shape.${face.kind}`)].filter(Boolean).join(' · ')
}

/** What the value is of: a measured point itself, the worst one near the place, or the surface; by its name among `several`. */
function what(part: Part, valued: boolean, several: boolean, words: Words): string {
  const { kind, role, reach, name } = part.object
  if (valued && reach) return `${words.of('hover.worst')} (≤ ${words.number(reach, 2)} mm)`
  return valued && kind === 'points' && role === 'measured' ? words.of('hover.point') : several && name ? (role === 'partition' && name.startsWith('class.') ? words.of(name) : name) : words.of(role)
}

/** No more digits than the stored step carries, and no fewer than the scale's. */
function digits(step: number, least: number): number {
  return step > 0 ? Math.max(least, Math.min(6, Math.floor(-Math.log10(step)))) : least
}
