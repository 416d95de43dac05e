import type { Stage } from '../stage/stage'
import type { State } from '../state'

interface View {
  eye: number[]
  range: [number, number]
  palette: string
  mode: 'bands' | 'continuous' | 'go_no_go'
  only: [number, number] | null
  comparison: number
}

/** Keeps the view in the address after `#`, so that it can be sent as a link to the same file. */
export function keepView(stage: Stage, state: State): void {
  let timer = 0
  const save = () => {
    const { scale, only, comparison } = state
    const view: View = { eye: stage.eye.save(), range: [scale.lower, scale.upper], palette: scale.palette, mode: scale.mode, only, comparison }
    try {
      history.replaceState(null, '', `#v=${encodeURIComponent(JSON.stringify(view))}`)
    } catch {
      // Some browsers allow no change of a local file's address; the view is then not kept.
    }
  }
  stage.onDraw(() => {
    clearTimeout(timer)
    timer = window.setTimeout(save, 500)
  })
}

/** Takes over the view in the address, if there is one. */
export function restoreView(stage: Stage, state: State): void {
  const match = /^#v=(.+)$/.exec(location.hash)
  if (!match) return
  try {
    const view = JSON.parse(decodeURIComponent(match[1])) as View
    const [lower, upper] = view.range.map(Number)
    if (state.manifest.maps[view.comparison]) state.choose(view.comparison)
    if (lower < upper && state.manifest.palettes?.[view.palette] && ['bands', 'continuous', 'go_no_go'].includes(view.mode))
      state.setScale({ lower, upper, palette: view.palette, mode: view.mode })
    if (Array.isArray(view.only)) state.setOnly([Number(view.only[0]), Number(view.only[1])])
    stage.eye.restore(view.eye.map(Number))
    stage.moved()
  } catch {
    // A damaged link shows the first view.
  }
}
