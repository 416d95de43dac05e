import { need } from '../dom'
import type { State } from '../state'
import type { Words } from '../words'
import type { Stage } from './stage'

/** Says how many of the places that matter most are hidden in this view. */
export function unseen(stage: Stage, state: State, words: Words): void {
  const line = need('unseen')
  const say = () => {
    const all = (state.manifest.first?.places ?? []).map((n) => state.manifest.picks[n])
    const places = all.filter((p) => p.map === null || p.map === state.comparison)
    const hidden = places.filter((p) => stage.sight.hidden(stage.placeOf(p), stage.slackOf(p))).length
    line.hidden = hidden === 0
    line.textContent = `${words.of('hidden.here')} ${hidden} / ${places.length}`
  }
  words.onChange(say)
  stage.onDraw(say)
}
