import { el, need } from '../dom'
import { onKeys, showKeys } from '../page/keys'
import type { State } from '../state'
import type { Words } from '../words'
import { control } from './controls'
import { layers } from './layers'
import { ruler } from './ruler'
import { PlanView } from './view'

/** Makes the drawings of the page movable, and leads rows of the list to their places. */
export function openPlan(state: State, words: Words, step: (by: number) => void): void {
  const holder = need('drawing')
  const sheets = [...holder.querySelectorAll<HTMLElement>('.sheet')]
  const bar = el('div', { class: 'stage-tools', role: 'toolbar' })
  holder.append(bar)
  const readout = need('readout')
  const views = sheets.map((sheet) => {
    const drawing = sheet.querySelector<SVGSVGElement>('svg.plan')
    if (!drawing) throw new Error('a sheet is empty')
    drawing.tabIndex = 0
    const bar = ruler(sheet, words)
    const view: PlanView = new PlanView(drawing, () => bar.draw(view.pixel))
    const [ox, oy] = (drawing.dataset.origin ?? '0 0').split(' ').map(Number)
    // The direction in the plane that points upward: coordinates are those of the plane, however it is turned.
    const [a, b] = (drawing.dataset.up ?? '0 1').split(' ').map(Number)
    const decimals = () => Math.max(0, Math.min(9, 1 - Math.floor(Math.log10(view.pixel))))
    const over = (place: [number, number] | null) => {
      const shown = (x: number) => words.number(x, decimals())
      if (!place) return void (readout.textContent = '')
      const [u, v] = [ox + place[0], oy - place[1]]
      readout.textContent = `x ${shown(b * u + a * v)}  y ${shown(b * v - a * u)} mm`
    }
    control(view, over, (mark) => state.pick(mark))
    return view
  })
  let current = 0
  const showSheet = (n: number) => {
    current = n
    sheets.forEach((sheet, i) => (sheet.hidden = i !== n))
    views[n]?.resized()
  }
  const fill = () => {
    const items: HTMLElement[] = []
    if (sheets.length > 1) items.push(chooser(sheets, current, words, showSheet))
    for (const [name, key, word] of layers()) {
      const b = el('button', { type: 'button', 'aria-pressed': String(!holder.classList.contains(`no-${name}`)), title: `${words.of(word)} (${key})` }, words.of(word))
      b.addEventListener('click', () => toggle(name))
      items.push(b)
    }
    const fit = el('button', { type: 'button', title: `${words.of('tool.fit')} (F)` }, words.of('tool.fit'))
    fit.addEventListener('click', () => views[current]?.fit())
    bar.replaceChildren(...items, fit)
    for (const { drawing } of views) drawing.setAttribute('aria-label', words.of('drawing.label'))
  }
  const toggle = (name: string) => {
    holder.classList.toggle(`no-${name}`)
    fill()
  }
  state.listen((what) => {
    if (what !== 'pick') return
    for (const old of document.querySelectorAll('.chosen')) old.classList.remove('chosen')
    const part = holder.querySelector<SVGGraphicsElement>(`[data-mark="${state.picked}"]`)
    if (!part) return
    showSheet(sheets.findIndex((sheet) => sheet.contains(part)))
    fill()
    part.classList.add('chosen')
    views[current]?.show(part)
    showCourse(state.picked)
  })
  const acts: Record<string, () => void> = {
    f: () => views[current]?.fit(),
    j: () => step(1),
    k: () => step(-1),
    '?': () => showKeys(words, state),
    escape: () => (state.picked >= 0 ? state.pick(-1) : views[current]?.fit()),
    ...Object.fromEntries(layers().map(([name, key]) => [key.toLowerCase(), () => toggle(name)])),
  }
  onKeys((key) => acts[key])
  words.onChange(() => {
    fill()
    views[current]?.apply()
  })
  new ResizeObserver(() => views[current]?.resized()).observe(holder)
  window.addEventListener('beforeprint', () => {
    for (const details of document.querySelectorAll('details')) details.open = true
    for (const view of views) view.paper()
  })
  window.addEventListener('afterprint', () => views[current]?.resized())
  fill()
  showSheet(0)
  need('stage').classList.add('live')
}

/** Which of several planes is drawn. */
function chooser(sheets: HTMLElement[], current: number, words: Words, choose: (n: number) => void): HTMLSelectElement {
  const name = (sheet: HTMLElement) => `${words.of('plane')} ${Number(sheet.dataset.plane ?? 0) + 1}`
  const box = el('select', { 'aria-label': words.of('plane'), title: words.of('plane') }, ...sheets.map((s, i) => el('option', { value: i, selected: i === current }, name(s))))
  box.addEventListener('change', () => {
    choose(Number(box.value))
    showFirstCourse(sheets[Number(box.value)])
  })
  return box
}

/** The residuals of the contour that a row of the list belongs to; rows of no contour leave what there is. */
function showCourse(mark: number): void {
  const contour = document.querySelector(`tr[data-pick="${mark}"]`)?.closest<HTMLElement>('[data-contour]')?.dataset.contour
  if (contour === undefined) return
  for (const course of document.querySelectorAll<HTMLElement>('.course')) course.hidden = course.dataset.contour !== contour
}

function showFirstCourse(sheet: HTMLElement): void {
  const mark = sheet.querySelector<SVGElement>('.segment[data-mark]')?.dataset.mark
  if (mark) showCourse(Number(mark))
  else for (const course of document.querySelectorAll<HTMLElement>('.course')) course.hidden = true
}
