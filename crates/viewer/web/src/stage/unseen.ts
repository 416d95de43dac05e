import { need } from '../dom'
import type { State } from '../state'
import type { Words } from '../words'
import type { Stage } from './stage'

/** Says how many of the places that matter most are hidden in this view. */
export function unseen(stage: Stage, state: State, words: Words): void {
  const line = need('unseen')
  const say = () => {
    const all = (state.manifest.first?.places ?? []).map((n) => state.manifest.picks[n])
    // Of characteristics only while they are shown: a map of deviations takes their place.
    const places = all.filter((p) => (p.map === null || p.map === state.comparison) && !(p.frame && state.mapped))
    const hidden = places.filter((p) => stage.endOf(p).hidden).length
    line.hidden = hidden === 0
    line.textContent = `${words.of('hidden.here')} ${hidden} / ${places.length}`
  }
  words.onChange(say)
  stage.onDraw(say)
}
