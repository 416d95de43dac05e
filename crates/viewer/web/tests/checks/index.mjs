// Every check of the page: a name and what it does in a browser session. `alone` are those that ask when something is drawn.
import { clouds } from './clouds.mjs'
import { colors } from './colors.mjs'
import { curvature } from './curvature.mjs'
import { defects } from './defects.mjs'
import { edges } from './edges.mjs'
import { first } from './first.mjs'
import { drawing } from './drawing.mjs'
import { fit } from './fit.mjs'
import { flags } from './flags.mjs'
import { inspect } from './inspect.mjs'
import { layout } from './layout.mjs'
import { pace } from './pace.mjs'
import { reading } from './reading.mjs'
import { repair } from './repair.mjs'
import { scale } from './scale.mjs'
import { segment } from './segment.mjs'
import { trend } from './trend.mjs'
import { trust } from './trust.mjs'
import { views } from './views.mjs'
import { words } from './words.mjs'

export const checks = [...trust, ...clouds, ...colors, ...scale, ...reading, ...first, ...edges, ...flags, ...defects, ...fit, ...repair, ...segment, ...curvature, ...inspect, ...drawing, ...trend, ...views, ...words, ...layout]
export const alone = pace
