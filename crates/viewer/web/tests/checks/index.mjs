// Every check of the page: a name and what it does in a browser session.
import { colors } from './colors.mjs'
import { reading } from './reading.mjs'
import { scale } from './scale.mjs'
import { trust } from './trust.mjs'
import { views } from './views.mjs'
import { words } from './words.mjs'

export const checks = [...trust, ...colors, ...scale, ...reading, ...views, ...words]
