import { el, svg } from '../dom'
import type { Frame } from '../manifest'
import type { Words } from '../words'

/** What is allowed, as a drawing writes it: no zeros behind the last digit. */
function allowed(frame: Frame, words: Words): string {
  const short = (x: number) => {
    const text = words.number(x, frame.decimals)
    return frame.decimals > 0 ? text.replace(/0+$/, '').replace(/[.,]$/, '') : text
  }
  const name = frame.parameter === null ? '' : `${frame.parameter}\u00a0`
  const lower = frame.lower === null ? '' : `${short(frame.lower)}\u2009…\u2009`
  const limits = `${name}${frame.diametral ? '⌀' : ''}${lower}${short(frame.upper)}${frame.unit}`
  return [limits, ...frame.letters].join('\u00a0')
}

function found(frame: Frame, words: Words): string {
  return frame.value === null ? '–' : words.number(frame.value, frame.decimals) + frame.unit
}

/** The frame in a line of text, without its sign. */
export function frameText(frame: Frame, words: Words): string {
  const material = frame.material === null ? '' : `\u00a0(${frame.material})`
  return `${[allowed(frame, words) + material, ...frame.datums].join(' | ')}\u2002${found(frame, words)}`
}

/** The frame as cells: sign, what is allowed, datums; then the value. */
export function frameCells(frame: Frame, words: Words): HTMLElement[] {
  const cell = (...content: (string | Node)[]) => el('span', { class: 'cell' }, ...content)
  const sign = frame.sign ? [cell(signOf(frame.sign, {}))] : []
  const material = frame.material === null ? [] : [circled(frame.material)]
  const datums = frame.datums.map((datum) => {
    const [, name = datum, letter] = /^(.*)\(([ML])\)$/.exec(datum) ?? []
    return cell(name, ...(letter === undefined ? [] : [circled(letter)]))
  })
  return [el('span', { class: 'cells' }, ...sign, cell(allowed(frame, words), ...material), ...datums), el('strong', {}, found(frame, words))]
}

/** The letter of a material requirement in its circle: few fonts have that sign. */
function circled(letter: string): HTMLElement {
  return el('span', { class: 'circled' }, letter)
}

/** A sign of a drawing in a square of 16. */
export function signOf(path: string, attributes: Record<string, string | number>): SVGElement {
  return svg('svg', { class: 'gdt', viewBox: '0 0 16 16', width: 16, height: 16, 'aria-hidden': 'true', ...attributes }, svg('path', { d: path }))
}
