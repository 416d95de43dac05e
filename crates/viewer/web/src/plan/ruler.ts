import { el } from '../dom'
import type { Words } from '../words'

/** Longest that the ruler is, pixels. */
const LONGEST = 120

/** A ruler in the corner of a drawing: a round length, as long as it is there. */
export function ruler(sheet: HTMLElement, words: Words): { draw(pixel: number): void } {
  const label = el('span')
  const bar = el('div', { class: 'ruler', 'aria-hidden': 'true' }, label)
  sheet.append(bar)
  const draw = (pixel: number) => {
    const longest = LONGEST * pixel
    const power = Math.floor(Math.log10(longest))
    const step = [5, 2, 1].find((s) => s * 10 ** power <= longest) ?? 1
    const length = step * 10 ** power
    bar.style.width = `${length / pixel}px`
    bar.dataset.length = String(length)
    label.textContent = `${words.number(length, Math.max(0, -power))} mm`
  }
  return { draw }
}
