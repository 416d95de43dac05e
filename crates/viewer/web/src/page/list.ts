import type { State } from '../state'

const rowsOf = (scope: ParentNode) => [...scope.querySelectorAll<HTMLElement>('tr[data-pick]')]

/** The list beside the stage: rows of places and of references can be chosen. Returns "choose the next or previous". */
export function list(state: State): { step: (by: number) => void } {
  const choosers = [...document.querySelectorAll<HTMLElement>('tr[data-choose]')]
  for (const table of document.querySelectorAll<HTMLElement>('table.pick')) walk(table)
  for (const row of rowsOf(document)) onRow(row, () => state.pick(Number(row.dataset.pick)))
  for (const row of choosers) {
    row.tabIndex = 0
    onRow(row, () => state.choose(Number(row.dataset.choose)))
  }
  state.listen((what) => {
    if (what === 'pick') mark(state.picked)
    if (what !== 'comparison') return
    for (const part of document.querySelectorAll<HTMLElement>('[data-comparison]')) part.hidden = Number(part.dataset.comparison) !== state.comparison
    for (const row of choosers) row.setAttribute('aria-selected', String(Number(row.dataset.choose) === state.comparison))
    mark(-1)
  })
  const step = (by: number) => {
    const numbers = state.picks.map(([n]) => n)
    if (numbers.length === 0) return
    const at = numbers.indexOf(state.picked)
    state.pick(numbers[(at + by + numbers.length + (at < 0 && by < 0 ? 1 : 0)) % numbers.length])
  }
  return { step }
}

/** Shows which row is chosen, wherever it lies. */
function mark(number: number): void {
  for (const row of rowsOf(document)) row.removeAttribute('aria-selected')
  const row = document.querySelector<HTMLElement>(`tr[data-pick="${number}"]`)
  if (!row) return
  row.closest('details')?.setAttribute('open', '')
  row.setAttribute('aria-selected', 'true')
  row.scrollIntoView({ block: 'nearest' })
}

function onRow(row: HTMLElement, act: () => void): void {
  row.addEventListener('click', act)
  row.addEventListener('keydown', (e) => {
    if (e.key !== 'Enter' && e.key !== ' ') return
    e.preventDefault()
    act()
  })
}

/** Tab reaches a table once; the arrows go from row to row. */
function walk(table: HTMLElement): void {
  const rows = rowsOf(table)
  rows.forEach((row, i) => {
    row.tabIndex = i === 0 ? 0 : -1
    row.addEventListener('keydown', (e) => {
      const next = { ArrowDown: i + 1, ArrowUp: i - 1, Home: 0, End: rows.length - 1 }[e.key]
      if (next === undefined || !rows[next]) return
      e.preventDefault()
      row.tabIndex = -1
      rows[next].tabIndex = 0
      rows[next].focus()
    })
    row.addEventListener('focus', () => {
      for (const other of rows) other.tabIndex = other === row ? 0 : -1
    })
  })
}
