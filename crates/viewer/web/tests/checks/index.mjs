// Every check of the page: a name and what it does in a browser session.
import { clouds } from './clouds.mjs'
import { colors } from './colors.mjs'
import { defects } from './defects.mjs'
import { first } from './first.mjs'
import { fit } from './fit.mjs'
import { inspect } from './inspect.mjs'
import { layout } from './layout.mjs'
import { pace } from './pace.mjs'
import { reading } from './reading.mjs'
import { repair } from './repair.mjs'
import { plan } from './plan.mjs'
import { scale } from './scale.mjs'
import { segment } from './segment.mjs'
import { trust } from './trust.mjs'
import { views } from './views.mjs'
import { words } from './words.mjs'

export const checks = [...trust, ...clouds, ...colors, ...scale, ...reading, ...first, ...defects, ...fit, ...repair, ...segment, ...inspect, ...plan, ...views, ...pace, ...words, ...layout]
