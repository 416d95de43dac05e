import { el, need, svg } from '../dom'
import { OPEN, type State } from '../state'
import type { Words } from '../words'
import { drawScale, type Drawing } from './drawing'

/** The scale's column beside the stage, and the same lying under it for narrow screens and print. */
export function scaleColumn(state: State, words: Words): void {
  const column = need('scale')
  // Colors of what is not shown would be taken for those that are.
  const appear = () => {
    column.hidden = need('figure').hidden = !state.mapped
    document.body.classList.toggle('no-scale', !state.mapped)
  }
  const chart = svg('svg', { class: 'distribution', role: 'img' })
  const lying = svg('svg', { class: 'distribution lying', role: 'img' })
  const area = el('div', { class: 'chart' }, chart)
  const only = el('p', { class: 'only', 'aria-live': 'polite' })
  const low = el('p', { class: 'end low' })
  const high = el('p', { class: 'end high' })
  const controls = el('div', { class: 'controls' })
  column.append(el('p', { class: 'axis' }), high, area, low, only, controls)
  const ends = el('p', { class: 'ends' })
  need('figure').replaceChildren(lying, ends)

  let drawing: Drawing
  let lyingDrawing: Drawing
  const draw = () => {
    const box = area.getBoundingClientRect()
    drawing = drawScale(chart, state, words, Math.max(80, Math.round(box.height)), Math.max(100, Math.round(box.width)), true)
    // The column makes room, and is drawn anew when it has.
    area.style.minWidth = `${drawing.breadth}px`
    lyingDrawing = drawScale(lying, state, words, 760, 130, false)
  }
  const say = () => {
    const [quantity, highEnd, lowEnd] = state.quantity
    column.querySelector('.axis')?.replaceChildren(`${words.of(quantity)} / ${state.scale.unit}`)
    low.textContent = words.of(lowEnd)
    high.textContent = words.of(highEnd)
    ends.replaceChildren(...[lowEnd, highEnd].map((key) => el('span', {}, words.of(key))))
    only.replaceChildren()
    if (state.only) {
      const [from, to] = state.only.map((v) => words.onScale(v, state.scale))
      const found = state.share(...state.only)
      const share = found ? words.share(found) : ''
      only.append(el('span', {}, `${words.of('scale.only')} ${from} … ${to}: `), el('strong', {}, share))
      const clear = el('button', { type: 'button' }, words.of('scale.all'))
      clear.addEventListener('click', () => state.setOnly(null))
      only.append(clear)
    } else only.append(words.of('scale.hint'))
    fillControls(controls, state, words)
  }
  const update = () => {
    say()
    draw()
  }
  brush(chart, state, () => drawing)
  new ResizeObserver(draw).observe(area)
  state.listen((what) => {
    if (what === 'hover') for (const d of [drawing, lyingDrawing]) d.mark(state.hover)
    else if (what === 'look') appear()
    else if (what === 'scale' || what === 'only' || what === 'comparison' || what === 'log') update()
  })
  words.onChange(update)
  appear()
  update()
}

/** Dragging along the chart shows only that range on the part; a click on a band shows the band. */
function brush(chart: SVGSVGElement, state: State, drawing: () => Drawing): void {
  let from: number | null = null
  const along = (e: PointerEvent) => e.clientY - chart.getBoundingClientRect().top
  chart.addEventListener('pointerdown', (e) => {
    from = along(e)
    chart.setPointerCapture(e.pointerId)
  })
  chart.addEventListener('pointermove', (e) => {
    if (from === null || Math.abs(along(e) - from) < 4) return
    const ends = [drawing().value(from), drawing().value(along(e))]
    state.setOnly([Math.min(...ends), Math.max(...ends)])
  })
  chart.addEventListener('pointerup', (e) => {
    if (from !== null && Math.abs(along(e) - from) < 4) {
      const value = drawing().value(from)
      const limits = [-OPEN, ...state.colors.limits, OPEN]
      const i = limits.findIndex((limit, k) => k + 1 < limits.length && value >= limit && value <= limits[k + 1])
      const range: [number, number] = [limits[i], limits[i + 1]]
      state.setOnly(state.only && state.only[0] === range[0] && state.only[1] === range[1] ? null : range)
    }
    from = null
  })
}

function fillControls(target: HTMLElement, state: State, words: Words): void {
  const { scale } = state
  const select = (label: string, value: string, options: [string, string][], change: (value: string) => void) => {
    const box = el('select', { 'aria-label': words.of(label), title: words.of(label) }, ...options.map(([v, key]) => el('option', { value: v, selected: v === value }, words.of(key))))
    box.addEventListener('change', () => change(box.value))
    return box
  }
  const range = el('input', { type: 'text', inputmode: 'decimal', size: 6, value: words.number(scale.upper, scale.decimals).replace(/[^\d.,]/g, ''), 'aria-label': words.of('scale.range') })
  range.addEventListener('change', () => {
    const upper = Number(range.value.replace(',', '.'))
    if (upper > 0 && Number.isFinite(upper)) state.setScale({ lower: -upper, upper })
    else range.value = words.number(scale.upper, scale.decimals)
  })
  const modes: [string, string][] = [
    ['bands', 'scale.bands'],
    ['continuous', 'scale.continuous'],
  ]
  if (scale.tolerance) modes.push(['go_no_go', 'scale.go_no_go'])
  const log = el('input', { type: 'checkbox', checked: state.log })
  log.addEventListener('change', () => state.toggle('log'))
  const reset = el('button', { type: 'button' }, words.of('scale.reset'))
  reset.addEventListener('click', () => state.resetScale())
  target.replaceChildren(
    el('label', {}, words.of('scale.range'), range),
    select('scale.mode', scale.mode, modes, (mode) => state.setScale({ mode: mode as typeof scale.mode })),
    select('scale.palette', scale.palette, ['inspect', 'safe', 'mono'].map((p) => [p, `scale.${p}`]), (palette) => state.setScale({ palette })),
    el('label', {}, log, words.of('scale.log')),
    reset,
  )
}
