import type { Flags } from '../stage/flags'
import type { Stage } from '../stage/stage'

/** The picture's size on paper in CSS pixels (186 × 110 mm at 150 to the inch), drawn twice as fine: 300 dpi. */
const WIDTH = 1098
const HEIGHT = 650
const FINE = 2

/**
 * Before printing all lists are opened, and the stored picture and its numbers become what is on the stage: on white, in
 * full detail, in the shape that paper has.
 */
export function printStage(stage: Stage, flags: Flags, picture: HTMLImageElement, numbers: SVGSVGElement): void {
  const stored = { src: picture.src, viewBox: numbers.getAttribute('viewBox') ?? '', children: [...numbers.childNodes] }
  window.addEventListener('beforeprint', () => {
    for (const details of document.querySelectorAll('details')) details.open = true
    stage.canvas.classList.add('on-paper')
    picture.src = stage.pictureOf(WIDTH, HEIGHT, FINE, () => flags.roomOnPaper, () => flags.drawInto(numbers))
    stage.canvas.classList.remove('on-paper')
    stage.recolor()
    stage.settle()
  })
  window.addEventListener('afterprint', () => {
    picture.src = stored.src
    numbers.setAttribute('viewBox', stored.viewBox)
    numbers.replaceChildren(...stored.children)
  })
}
