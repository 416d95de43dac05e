import { el } from '../dom'
import type { Stage } from '../stage/stage'
import { STANDARD } from '../stage/eye'
import type { State } from '../state'
import type { Words } from '../words'

/** Keys of the page; those that move the eye belong to the stage itself. */
export function keys(stage: Stage, state: State, words: Words, step: (by: number) => void): void {
  document.addEventListener('keydown', (e) => {
    const typing = e.target instanceof HTMLInputElement || e.target instanceof HTMLSelectElement
    if (typing || e.ctrlKey || e.metaKey || e.altKey) return
    const view = STANDARD[Number(e.key) - 1]
    const acts: Record<string, () => void> = {
      f: () => stage.fit(),
      n: () => state.show('reference', !state.visible.reference),
      a: () => state.show('measured', !state.visible.measured),
      m: () => state.toggle('map'),
      l: () => state.toggle('flat'),
      g: () => state.toggle('flags'),
      p: () => state.toggle('perspective'),
      j: () => step(1),
      k: () => step(-1),
      '?': () => showKeys(words),
      escape: () => state.setOnly(null),
    }
    const act = view ? () => stage.look(view) : acts[e.key.toLowerCase()]
    if (!act || document.querySelector('dialog[open]')) return
    e.preventDefault()
    act()
  })
}

/** The list of all keys. */
export function showKeys(words: Words): void {
  const rows: [string, string][] = [
    ['← → ↑ ↓', 'keys.turn'],
    ['Shift ← → ↑ ↓', 'keys.pan'],
    ['+ −', 'keys.zoom'],
    ['F', 'tool.fit'],
    ['1 … 7', 'tool.views'],
    ['J K', 'keys.next'],
    ['N', 'keys.nominal'],
    ['A', 'keys.actual'],
    ['M', 'tool.map'],
    ['L', 'tool.flat'],
    ['G', 'tool.flags'],
    ['P', 'tool.perspective'],
    ['Esc', 'keys.escape'],
    ['?', 'tool.keys'],
  ]
  const list = el('dl', {}, ...rows.flatMap(([key, word]) => [el('dt', {}, el('kbd', {}, key)), el('dd', {}, words.of(word))]))
  const close = el('button', { type: 'button' }, words.of('tool.close'))
  const dialog = el('dialog', { class: 'keys' }, el('h2', {}, words.of('keys.title')), list, el('p', {}, words.of('keys.mouse')), close)
  close.addEventListener('click', () => dialog.close())
  dialog.addEventListener('close', () => dialog.remove())
  document.body.append(dialog)
  dialog.showModal()
}
