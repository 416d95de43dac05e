import { readTexts, type Manifest } from './manifest'
import type { Share } from './scale/distribution'

/** Language of words and numbers; can change while the page is open. */
export class Words {
  private readonly texts = readTexts()
  private readonly listeners: (() => void)[] = []
  language: string

  constructor(private readonly manifest: Manifest) {
    this.language = manifest.language
  }

  get languages(): string[] {
    return Object.keys(this.texts)
  }

  of(key: string): string {
    return this.texts[this.language]?.[key] ?? key
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener)
  }

  /** Writes every word and number of the page anew. */
  speak(language: string): void {
    if (!this.texts[language]) return
    this.language = language
    document.documentElement.lang = language
    for (const node of document.querySelectorAll<HTMLElement>('[data-t]')) node.textContent = this.of(node.dataset.t ?? '')
    for (const node of document.querySelectorAll<HTMLElement>('[data-n]')) {
      const value = Number(node.dataset.n)
      const decimals = Number(node.dataset.d)
      node.textContent = node.dataset.s === undefined ? this.number(value, decimals) : this.signed(value, decimals)
    }
    for (const node of document.querySelectorAll<HTMLElement>('[data-e]')) node.textContent = this.scientific(Number(node.dataset.e), Number(node.dataset.d))
    for (const node of document.querySelectorAll<HTMLElement>('[data-t-alt]')) node.setAttribute('alt', this.of(node.dataset.tAlt ?? ''))
    const title = document.querySelector<HTMLElement>('title')
    if (title?.dataset.word) document.title = `${this.of(title.dataset.word)} · ${title.dataset.name ?? ''}`
    for (const listener of this.listeners) listener()
  }

  /** `value` with `decimals` digits, grouped, with a true minus sign; never "−0". */
  number(value: number, decimals: number): string {
    const plain = Math.abs(value).toFixed(decimals)
    const [whole, fraction] = plain.split('.')
    const grouped = whole.replace(/\B(?=(\d{3})+$)/g, this.group)
    const sign = value < 0 && /[1-9]/.test(plain) ? '\u2212' : ''
    return sign + grouped + (fraction ? this.point + fraction : '')
  }

  /** A positive number too small for digits after the point, as 1.5e−7. */
  scientific(value: number, decimals: number): string {
    return value.toExponential(decimals).replace('.', this.point).replace('-', '\u2212').replace('+', '')
  }

  signed(value: number, decimals: number): string {
    const text = this.number(value, decimals)
    return value > 0 && /[1-9]/.test(text) ? `+${text}` : text
  }

  /** A value as the numbers beside a scale: with a sign where the scale goes below zero, none where it begins at zero. */
  onScale(value: number, scale: { lower: number; decimals: number }, decimals = scale.decimals): string {
    return scale.lower < 0 ? this.signed(value, decimals) : this.number(value, decimals)
  }

  /** A share (0 to 1) in percent: all and none only where it is all or none. */
  percent(share: number, decimals: number): string {
    const unit = 10 ** -decimals
    let p = 100 * share
    if (share < 1 && p > 100 - unit) p = 100 - unit
    else if (share > 0 && p < unit) p = unit
    return `${this.number(p, decimals)}\u00a0%`
  }

  /** A share, marked where it is not counted. */
  share({ share, exact }: Share): string {
    return `${exact ? '' : '≈'}${this.percent(share, share > 0 && share < 0.001 ? 2 : 1)}`
  }

  private get point(): string {
    return this.manifest.decimal ?? (this.language === 'de' || this.language === 'ru' ? ',' : '.')
  }

  private get group(): string {
    if (this.language === 'ru') return '\u00a0'
    return this.point === ',' ? '.' : ','
  }
}
