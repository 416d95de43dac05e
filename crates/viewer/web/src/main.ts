import { el, need } from './dom'
import { readManifest } from './manifest'
import { announcer } from './page/announce'
import { openCharts } from './page/charts'
import { keys } from './page/keys'
import { keepView, restoreView } from './page/link'
import { list } from './page/list'
import { printStage } from './page/print'
import { openPlan } from './plan/plan'
import { headerTools, stageTools } from './page/tools'
import { scaleColumn } from './scale/column'
import { control } from './stage/controls'
import { viewCube } from './stage/cube'
import { Flags } from './stage/flags'
import { hover } from './stage/hover'
import { Stage } from './stage/stage'
import { unseen } from './stage/unseen'
import { State } from './state'
import { Words } from './words'

const manifest = readManifest()
const words = new Words(manifest)
const state = new State(manifest)
headerTools(words, state)
if (manifest.scale) scaleColumn(state, words)
const rows = list(state)
announcer(state)
if (state.charted) openCharts(state, words, rows.step)
else if (state.planar) openPlan(state, words, rows.step)
else void openStage()

/** Puts the 3D stage over the stored picture; where that fails the picture stays, with the reason. */
async function openStage(): Promise<void> {
  const section = need('stage')
  const notice = el('p', { class: 'notice', role: 'status' })
  const say = (key: string | null) => {
    notice.hidden = key === null
    if (key) {
      notice.dataset.t = key
      notice.textContent = words.of(key)
    }
  }
  section.append(notice)
  const canvas = el('canvas', { tabindex: 0, role: 'application' })
  let stage: Stage
  try {
    stage = new Stage(canvas, state)
  } catch {
    return say('stage.none')
  }
  const overlay = el('div', { class: 'overlay' })
  section.append(canvas, overlay)
  const label = () => canvas.setAttribute('aria-label', words.of('stage.label'))
  words.onChange(label)
  label()
  say('stage.loading')

  const flags = new Flags(overlay, stage, state, words)
  unseen(stage, state, words)
  stageTools(overlay, stage, state, words)
  viewCube(overlay, stage, words)
  hover(stage, overlay, state, words)
  control(stage)
  keys(stage, state, words, rows.step)
  printStage(stage, flags, need('picture') as HTMLImageElement, need('flagged') as Element as SVGSVGElement)
  state.listen((what) => {
    if (what !== 'hover' && what !== 'log' && what !== 'flags') stage.applyState()
    const pick = what === 'pick' ? manifest.picks[state.picked] : null
    if (pick) stage.flyTo(pick)
  })
  new ResizeObserver(() => stage.resize(section.clientWidth, section.clientHeight)).observe(section)
  stage.resize(section.clientWidth, section.clientHeight)
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => stage.recolor())
  new MutationObserver(() => stage.recolor()).observe(document.documentElement, { attributeFilter: ['data-theme'] })

  let gone = 0
  canvas.addEventListener('webglcontextlost', (e) => {
    e.preventDefault()
    say('stage.lost')
    gone = window.setTimeout(() => {
      section.classList.remove('live')
      say('stage.none')
    }, 3000)
  })
  canvas.addEventListener('webglcontextrestored', () => {
    clearTimeout(gone)
    section.classList.add('live')
    say(null)
    stage.applyState()
  })
  try {
    await stage.load()
    restoreView(stage, state)
    keepView(stage, state)
    // Drawn before it is seen: flags laid out without the part would show what it hides.
    stage.show()
    section.classList.add('live')
    say(null)
  } catch {
    canvas.remove()
    overlay.remove()
    say('stage.broken')
  }
}
