import type { Stage } from '../stage/stage'

/** Before printing all lists are opened and the stored picture becomes what is on the stage, on white and in full detail. */
export function printStage(stage: Stage, picture: HTMLImageElement): void {
  const stored = picture.src
  window.addEventListener('beforeprint', () => {
    for (const details of document.querySelectorAll('details')) details.open = true
    const { canvas } = stage
    canvas.classList.add('on-paper')
    stage.drawNow()
    picture.src = canvas.toDataURL('image/png')
    canvas.classList.remove('on-paper')
    stage.drawNow()
  })
  window.addEventListener('afterprint', () => {
    picture.src = stored
  })
}
