import { need, svg } from '../dom'
import type { State } from '../state'
import type { Words } from '../words'
import { onKeys, showKeys } from './keys'

/** The document as far as the charts need it. */
interface Trend {
  parts: { name: string }[]
  characteristics: { id: string; unit: string; values: (number | null)[]; verdicts: string[]; out_of_control: { part: number; rule: string }[] }[]
}

/** Lets the reader go from part to part through the courses of a trend. */
export function openCharts(state: State, words: Words, step: (by: number) => void): void {
  const trend = JSON.parse(need('manifest').textContent ?? '{}').result as Trend
  const plots = [...document.querySelectorAll<SVGSVGElement>('.chart .plot')]
  const small = [...document.querySelectorAll<SVGSVGElement>('.spark')]
  const readout = need('readout')
  const count = trend.parts.length
  const line = (chart: SVGSVGElement, part: number | null, name: string) => {
    chart.querySelector(`.${name}`)?.remove()
    if (part === null || part < 0 || part >= count) return
    const { width, height } = chart.viewBox.baseVal
    chart.append(svg('path', { class: name, d: `M${(width * (part + 0.5)) / count} 0V${height}` }))
  }
  const say = (chart: SVGSVGElement, part: number | null) => {
    const c = trend.characteristics[Number(chart.closest<HTMLElement>('.chart')?.dataset.of)]
    if (part === null || !c) return void (readout.textContent = '')
    const value = c.values[part]
    const decimals = Number(chart.closest<HTMLElement>('.chart')?.dataset.decimals)
    const unit = c.unit === '1' ? '' : ` ${c.unit === 'deg' ? '°' : c.unit}`
    const rules = c.out_of_control.filter((o) => o.part === part).map((o) => words.of(`rule.${o.rule}`))
    const name = trend.parts[part].name.split(/[/\\]/).pop()
    const told = value === null ? [] : [words.number(value, decimals) + unit]
    readout.textContent = [`${part + 1} · ${name}`, c.id, ...told, words.of(`verdict.${c.verdicts[part]}`), ...rules].join(' · ')
  }
  const label = () => plots.forEach((p) => p.setAttribute('aria-label', `${trend.characteristics[Number(p.closest<HTMLElement>('.chart')?.dataset.of)]?.id ?? ''}: ${words.of('chart.label')}`))
  for (const plot of plots) {
    plot.tabIndex = 0
    const at = (e: PointerEvent | MouseEvent) => {
      const box = plot.getBoundingClientRect()
      return Math.min(count - 1, Math.max(0, Math.floor(((e.clientX - box.left) / box.width) * count)))
    }
    plot.addEventListener('pointermove', (e) => {
      line(plot, at(e), 'under')
      say(plot, at(e))
    })
    plot.addEventListener('pointerleave', () => {
      line(plot, null, 'under')
      say(plot, null)
    })
    plot.addEventListener('click', (e) => state.pick(at(e)))
    plot.addEventListener('keydown', (e) => {
      const next = { ArrowLeft: state.picked < 0 ? count - 1 : state.picked - 1, ArrowRight: state.picked + 1, Home: 0, End: count - 1 }[e.key]
      if (next === undefined) return
      e.preventDefault()
      if (next < 0 || next >= count) return
      state.pick(next)
      say(plot, next)
    })
  }
  state.listen((what) => {
    if (what !== 'pick') return
    for (const chart of [...plots, ...small]) line(chart, state.picked, 'at')
  })
  const acts: Record<string, () => void> = { j: () => step(1), k: () => step(-1), '?': () => showKeys(words, state), escape: () => state.pick(-1) }
  onKeys((key) => acts[key])
  words.onChange(label)
  label()
  need('stage').classList.add('live')
}
