type Child = Node | string
type Attributes = Record<string, string | number | boolean | null | undefined>

const SVG = 'http://www.w3.org/2000/svg'

function fill<E extends Element>(element: E, attributes: Attributes, children: Child[]): E {
  for (const [name, value] of Object.entries(attributes))
    if (value !== null && value !== undefined && value !== false) element.setAttribute(name, value === true ? '' : String(value))
  element.append(...children)
  return element
}

/** A new HTML element. Text becomes text nodes, never markup. */
export function el<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  return fill(document.createElement(tag), attributes, children)
}

/** A new SVG element. */
export function svg<K extends keyof SVGElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): SVGElementTagNameMap[K] {
  return fill(document.createElementNS(SVG, tag), attributes, children)
}

/** Width of a text as the page's style shows it in `drawing`, in the drawing's own units; 0 where the drawing is not shown. */
export function textWidth(drawing: SVGElement, text: string, name = ''): number {
  const shown = svg('text', { class: name, visibility: 'hidden' }, text)
  drawing.append(shown)
  const width = shown.getComputedTextLength()
  shown.remove()
  return width
}

/** An element that the page is written with. */
export function need(id: string): HTMLElement {
  const element = document.getElementById(id)
  if (!element) throw new Error(`#${id} is missing`)
  return element
}
