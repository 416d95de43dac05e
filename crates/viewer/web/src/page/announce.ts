import { el } from '../dom'
import type { State } from '../state'

/** Says what was chosen to those who cannot see it. */
export function announcer(state: State): void {
  const line = el('p', { class: 'unseen', 'aria-live': 'polite' })
  document.body.append(line)
  state.listen((what) => {
    if (what !== 'pick') return
    const row = document.querySelector<HTMLTableRowElement>(`tr[data-pick="${state.picked}"]`)
    const kind = row?.closest('details')?.querySelector('.kind-name')?.textContent ?? ''
    const cells = [...(row?.cells ?? [])].map((c) => c.textContent)
    line.textContent = [kind, ...cells].filter(Boolean).join(' ')
  })
}
