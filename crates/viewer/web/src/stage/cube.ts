import { Matrix4 } from 'three'
import { el } from '../dom'
import type { Words } from '../words'
import type { StandardView } from './eye'
import type { Stage } from './stage'

const SIZE = 54
/** Each face's own turn, for a model whose z points up: x to the right, y to the back. */
const FACES: Record<Exclude<StandardView, 'iso'>, string> = {
  front: 'rotateX(-90deg)',
  back: 'rotateX(-90deg) rotateY(180deg)',
  left: 'rotateX(-90deg) rotateY(-90deg)',
  right: 'rotateX(-90deg) rotateY(90deg)',
  top: '',
  bottom: 'rotateX(180deg)',
}

/** A cube that turns with the part; each face looks from there. */
export function viewCube(overlay: HTMLElement, stage: Stage, words: Words): void {
  const cube = el('div', { class: 'cube' })
  const holder = el('div', { class: 'cube-holder' }, cube)
  const faces = Object.entries(FACES).map(([view, turn]) => {
    const face = el('button', { type: 'button', 'data-view': view })
    face.style.transform = `${turn} translateZ(${SIZE / 2}px)`
    face.addEventListener('click', () => stage.look(view as StandardView))
    cube.append(face)
    return { view, face }
  })
  const say = () => {
    for (const { view, face } of faces) face.textContent = words.of(`view.${view}`)
  }
  words.onChange(say)
  say()
  overlay.append(holder)
  // CSS has y down; a model whose y points up is stood up first.
  const flip = new Matrix4().makeScale(1, -1, 1)
  const stand = stage.eye.vertical.y === 1 ? new Matrix4().makeRotationX(-Math.PI / 2) : new Matrix4()
  stage.onDraw(() => {
    const turn = new Matrix4().makeRotationFromQuaternion(stage.eye.turn.clone().invert())
    const m = flip.clone().multiply(turn).multiply(stand).multiply(flip)
    cube.style.transform = `matrix3d(${m.elements.map((x) => x.toFixed(5)).join(',')})`
  })
}
