import { el, need, svg } from '../dom'
import type { State } from '../state'
import type { Words } from '../words'
import type { Stage } from '../stage/stage'
import { ROLE_KEYS, showKeys } from './keys'
import { toggleTheme } from './theme'

const NAMES: Record<string, string> = { en: 'English', de: 'Deutsch', ru: 'Русский', 'zh-Hans': '中文' }

/** Language, light or dark, print and keys, in the header. */
export function headerTools(words: Words, state: State): void {
  const tools = need('tools')
  const language = el('select', {}, ...words.languages.map((code) => el('option', { value: code, selected: code === words.language, lang: code }, NAMES[code] ?? code)))
  language.addEventListener('change', () => words.speak(language.value))
  const button = (key: string, icon: string | Node, act: () => void) => {
    const b = el('button', { type: 'button', 'data-key': key }, icon)
    b.addEventListener('click', act)
    return b
  }
  const buttons = [button('tool.theme', '◐', toggleTheme), button('tool.print', printer(), () => window.print()), button('tool.keys', '?', () => showKeys(words, state))]
  const say = () => {
    language.setAttribute('aria-label', words.of('tool.language'))
    for (const b of buttons) {
      const label = words.of(b.dataset.key ?? '')
      b.title = label
      b.setAttribute('aria-label', label)
    }
  }
  words.onChange(say)
  say()
  tools.append(language, ...buttons)
}

function printer(): SVGElement {
  const path = 'M4 6V1h8v5M4 12H1V6h14v6h-3M4 9h8v6H4z'
  return svg('svg', { viewBox: '0 0 16 16', width: 15, height: 15, 'aria-hidden': 'true' }, svg('path', { d: path, fill: 'none', stroke: 'currentColor', 'stroke-width': 1.4 }))
}

/** Switches over the stage, top left. */
export function stageTools(overlay: HTMLElement, stage: Stage, state: State, words: Words): void {
  const bar = el('div', { class: 'stage-tools', role: 'toolbar' })
  overlay.append(bar)
  const fill = () => {
    const toggle = (key: string, on: boolean, act: () => void, hint: string, disabled = false) => {
      const title = `${words.of(key)} (${hint})`
      const b = el('button', { type: 'button', 'aria-pressed': String(on), title, disabled }, words.of(key))
      b.addEventListener('click', act)
      return b
    }
    const act = (key: string, does: () => void, hint: string) => {
      const b = el('button', { type: 'button', title: `${words.of(key)} (${hint})` }, words.of(key))
      b.addEventListener('click', does)
      return b
    }
    const items: HTMLElement[] = []
    const { maps, picks } = state.manifest
    if (maps.length > 1) items.push(chooser(state, words))
    for (const role of state.roles) items.push(toggle(role, state.visible[role], () => state.show(role, !state.visible[role]), ROLE_KEYS[role] ?? ''))
    // Nothing to switch while what is shown has no values.
    if (maps.length > 0) items.push(toggle('tool.map', state.map, () => state.toggle('map'), 'M', !state.mapped))
    if (maps.length > 0) items.push(toggle('tool.flat', state.flat, () => state.toggle('flat'), 'L', !state.mapped))
    if (picks.some((p) => p.value !== null || p.frame !== null)) items.push(toggle('tool.flags', state.flags, () => state.toggle('flags'), 'G'))
    if (state.colored) items.push(toggle('tool.model_colors', state.modelColors, () => state.toggle('modelColors'), 'C'))
    if (state.meshes) items.push(toggle('tool.backfaces', state.backfaces, () => state.toggle('backfaces'), 'B'))
    items.push(act('tool.fit', () => stage.fit(), 'F'))
    const focused = [...bar.children].indexOf(document.activeElement as Element)
    bar.replaceChildren(...items)
    if (focused >= 0) (bar.children[focused] as HTMLElement | undefined)?.focus()
  }
  words.onChange(fill)
  state.listen((what) => {
    if (what === 'look' || what === 'flags' || what === 'comparison') fill()
  })
  fill()
}

/** Which reference the part is compared with, or which quantity is shown. */
function chooser(state: State, words: Words): HTMLSelectElement {
  const name = (path: string) => path.split(/[/\\]/).pop() ?? path
  const { maps } = state.manifest
  const options = maps.map((m, i) => el('option', { value: i, selected: i === state.comparison }, m.quantity ? words.of(m.quantity[0]) : name(m.name)))
  const label = words.of(maps.some((m) => m.quantity) ? 'tool.quantity' : 'tool.reference')
  const box = el('select', { 'aria-label': label, title: label }, ...options)
  box.addEventListener('change', () => state.choose(Number(box.value)))
  return box
}
