import type { State } from '../state'

/** The list beside the stage: rows of worst places and of references can be chosen. Returns "choose the next or previous". */
export function list(state: State, flyTo: (worst: number) => void): { select: (worst: number) => void; step: (by: number) => void } {
  let selected = -1
  const rows = () => [...document.querySelectorAll<HTMLElement>(`.comparison[data-comparison="${state.comparison}"] tr[data-worst]`)]
  const select = (worst: number) => {
    selected = worst
    for (const row of document.querySelectorAll('tr[data-worst]')) row.removeAttribute('aria-selected')
    const row = rows()[worst]
    row?.setAttribute('aria-selected', 'true')
    row?.scrollIntoView({ block: 'nearest' })
    flyTo(worst)
  }
  const onRow = (row: HTMLElement, act: () => void) => {
    row.tabIndex = 0
    row.addEventListener('click', act)
    row.addEventListener('keydown', (e) => {
      if (e.key === 'Enter' || e.key === ' ') {
        e.preventDefault()
        act()
      }
    })
  }
  for (const row of document.querySelectorAll<HTMLElement>('tr[data-worst]')) onRow(row, () => select(Number(row.dataset.worst)))
  for (const row of document.querySelectorAll<HTMLElement>('tr[data-choose]')) onRow(row, () => state.choose(Number(row.dataset.choose)))
  state.listen((what) => {
    if (what !== 'comparison') return
    selected = -1
    for (const part of document.querySelectorAll<HTMLElement>('[data-comparison]')) part.hidden = Number(part.dataset.comparison) !== state.comparison
    for (const row of document.querySelectorAll<HTMLElement>('tr[data-choose]')) row.setAttribute('aria-selected', String(Number(row.dataset.choose) === state.comparison))
  })
  const step = (by: number) => {
    const n = rows().length
    if (n > 0) select((selected + by + n + (selected < 0 && by < 0 ? 1 : 0)) % n)
  }
  return { select, step }
}
