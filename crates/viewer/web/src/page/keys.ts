import { el } from '../dom'
import type { Stage } from '../stage/stage'
import { STANDARD } from '../stage/eye'
import { layers } from '../plan/layers'
import type { State } from '../state'
import type { Words } from '../words'

/** What switches an object or a layer of marks on and off. */
export const ROLE_KEYS: Record<string, string> = {
  measured: 'A', part: 'A', after: 'A', reference: 'N', before: 'N', deviation: 'N', partition: 'O', element: 'N', defects: 'D', edges: 'E', surface: 'N', iso_lines: 'E', net: 'D', reflection_lines: 'R', touching: 'D', changes: 'D',
}

interface Key {
  key: string
  word: string
  act: () => void
}

/** Keys that this page has a use for. */
function pageKeys(state: State): Key[] {
  const { maps, picks } = state.manifest
  const roles = state.roles.map((role) => ({ key: ROLE_KEYS[role], word: role, act: () => state.show(role, !state.visible[role]) }))
  const toggle = (key: string, word: string, what: Parameters<State['toggle']>[0], has: boolean) => (has ? [{ key, word, act: () => state.toggle(what) }] : [])
  return [
    ...roles.filter((r) => r.key),
    ...toggle('M', 'tool.map', 'map', maps.length > 0),
    ...toggle('L', 'tool.flat', 'flat', maps.length > 0),
    ...toggle('G', 'tool.flags', 'flags', picks.some((p) => p.value !== null || p.frame !== null)),
    ...toggle('C', 'tool.model_colors', 'modelColors', state.colored),
    ...toggle('B', 'tool.backfaces', 'backfaces', state.meshes),
    ...toggle('P', 'tool.perspective', 'perspective', true),
  ]
}

/** Acts on keys of the page, whatever has the focus, but not where one types, with a dialog open, or with a modifier. */
export function onKeys(act: (key: string) => (() => void) | undefined): void {
  document.addEventListener('keydown', (e) => {
    const typing = e.target instanceof HTMLInputElement || e.target instanceof HTMLSelectElement
    if (typing || e.ctrlKey || e.metaKey || e.altKey || document.querySelector('dialog[open]')) return
    const run = act(e.key.toLowerCase())
    if (!run) return
    e.preventDefault()
    run()
  })
}

/** Keys of the page; those that move the eye belong to the stage itself. */
export function keys(stage: Stage, state: State, words: Words, step: (by: number) => void): void {
  const own = Object.fromEntries(pageKeys(state).map((k) => [k.key.toLowerCase(), k.act]))
  const acts: Record<string, () => void> = {
    ...own,
    f: () => stage.fit(),
    j: () => step(1),
    k: () => step(-1),
    '?': () => showKeys(words, state),
    escape: () => (state.picked >= 0 ? state.pick(-1) : state.setOnly(null)),
  }
  onKeys((key) => {
    const view = STANDARD[Number(key) - 1]
    return view ? () => stage.look(view) : acts[key]
  })
}

/** The list of all keys. */
export function showKeys(words: Words, state: State): void {
  const { charted } = state
  const moves: [string, string][] = charted
    ? [['← →', 'keys.parts']]
    : state.planar
    ? [['← → ↑ ↓', 'keys.pan']]
    : [['← → ↑ ↓', 'keys.turn'], ['Shift ← → ↑ ↓', 'keys.pan'], ['1 … 7', 'tool.views']]
  const own: [string, string][] = charted ? [] : state.planar
    ? layers().map(([, key, word]) => [key, word])
    : pageKeys(state).map((k) => [k.key, k.word])
  const rows: [string, string][] = [
    ...moves,
    ...(charted ? [] : ([['+ −', 'keys.zoom'], ['F', 'tool.fit']] as [string, string][])),
    ['J K', 'keys.next'],
    ...own,
    ['Esc', 'keys.escape'],
    ['?', 'tool.keys'],
  ]
  const list = el('dl', {}, ...rows.flatMap(([key, word]) => [el('dt', {}, el('kbd', {}, key)), el('dd', {}, words.of(word))]))
  const close = el('button', { type: 'button' }, words.of('tool.close'))
  const dialog = el('dialog', { class: 'keys' }, el('h2', {}, words.of('keys.title')), list, el('p', {}, words.of(charted ? 'keys.mouse.charts' : state.planar ? 'keys.mouse.flat' : 'keys.mouse')), close)
  close.addEventListener('click', () => dialog.close())
  dialog.addEventListener('close', () => dialog.remove())
  document.body.append(dialog)
  dialog.showModal()
}
