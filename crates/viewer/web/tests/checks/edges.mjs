// The sharp edges of a surface are drawn, on a map too, and only those.
import assert from 'node:assert/strict'
import { screen, settled, stageBox, tool } from '../browser.mjs'
import { view } from './colors.mjs'

const key = async (page, k) => {
  await page.keyboard.press(k)
  await settled(page)
}

/** Where a box of 20 mm, from -10 to 10 about its middle, seen from a corner has its places on the screen: x to the right and front, y to the back. */
async function onScreen(page) {
  const box = await stageBox(page)
  const scale = box.height / (await view(page))
  const [s2, s6] = [2, 6].map(Math.sqrt)
  return ([x, y, z]) => [Math.round(box.cx + ((x + y) / s2) * scale), Math.round(box.cy - ((2 * z - x + y) / s6) * scale)]
}

/** Least brightness within two pixels of a place, as a share of the brightest there. */
function contrast(picture, [x, y]) {
  const all = []
  for (let i = -2; i <= 2; i++) for (let j = -2; j <= 2; j++) all.push(picture.at(x + i, y + j).reduce((a, b) => a + b))
  return Math.min(...all) / Math.max(...all)
}

/** The three edges that meet in the corner nearest to the reader, a third along; and the diagonals of the facets there. */
const EDGES = [[3, -10, 10], [10, -3, 10], [10, -10, -3]]
const FLAT = [[3, -3, 10], [-4, -4, 10], [3, -10, -3], [10, 3, 3], [-5, 2, 10], [10, 4, -6]]

export const edges = [
  [
    'a box in one colour has its edges, as a check and as a map, and none across its faces',
    async (session) => {
      for (const name of ['box', 'block'])
        for (const colorScheme of ['light', 'dark']) {
          const page = await session.report(name, { colorScheme })
          await key(page, '7')
          const at = await onScreen(page)
          const picture = await screen(page)
          for (const place of EDGES) assert.ok(contrast(picture, at(place)) < 0.7, `${name}: no edge at ${place}`)
          for (const place of FLAT) assert.ok(contrast(picture, at(place)) > 0.95, `${name}: a line at ${place}`)
          assert.deepEqual(page.seen.errors, [])
          await session.tidy()
        }
    },
  ],
  [
    'the cursor reads the value beneath an edge, and a smooth surface has none',
    async (session) => {
      const page = await session.report('box')
      await key(page, '7')
      const at = await onScreen(page)
      await page.mouse.move(...at([3, -10, 10]))
      assert.match(await page.evaluate(() => document.getElementById('readout').textContent), /^0\.0+ mm/)
      const sphere = await session.report('sphere', { width: 900, height: 700 })
      await key(sphere, '7')
      await key(sphere, 'l')
      const box = await stageBox(sphere)
      const picture = await screen(sphere)
      const dark = []
      for (let i = -100; i <= 100; i += 2) for (let j = -100; j <= 100; j += 2) if (contrast(picture, [box.cx + i, box.cy + j]) < 0.3) dark.push([i, j])
      assert.deepEqual(dark, [])
    },
  ],
  [
    'a CAD model has the edges of its faces and no others, the cursor names faces, and their colors are shown on request',
    async (session) => {
      const page = await session.report('model')
      await key(page, '7')
      const at = await onScreen(page)
      const picture = await screen(page)
      for (const place of [EDGES[0], EDGES[2], [4, 0, 10]]) assert.ok(contrast(picture, at(place)) < 0.7, `no edge at ${place}`)
      for (const place of [EDGES[1], ...FLAT]) assert.ok(contrast(picture, at(place)) > 0.95, `a line at ${place}`)
      const read = async (place) => {
        await page.mouse.move(...at(place))
        return page.evaluate(() => document.getElementById('readout').textContent)
      }
      assert.match(await read([3, -3, 10]), /face 101 · LID · plane/)
      assert.match(await read([3, -10, -3]), /face 102 · plane/)
      await key(page, 'c')
      const [r, g, b] = (await screen(page)).at(...at([-4, -4, 10]))
      assert.ok(r > 60 && g < 20 && b < 20, `${[r, g, b]}`)
      const [x, y, z] = (await screen(page)).at(...at([3, -10, -3]))
      assert.ok(y > 60 && z > 60, `${[x, y, z]}`)
      assert.deepEqual(page.seen.errors, [])
    },
  ],
  [
    'edges that crowd fade where they are, and those of the box beside them stay',
    async (session) => {
      const page = await session.report('pleats')
      await key(page, '7')
      await tool(page, 'Defects')
      await settled(page)
      const box = await stageBox(page)
      const picture = await screen(page)
      let [dark, light] = [0, 0]
      for (let x = box.x; x < box.x + box.width; x++)
        for (let y = box.y; y < box.y + box.height; y++) {
          const sum = picture.at(x, y).reduce((a, b) => a + b)
          dark += Number(sum < 150)
          light += Number(sum < 660)
        }
      // Lines of a pixel or two, and no area.
      assert.ok(dark > 200 && dark < 0.03 * light, `${dark} of ${light} pixels of the part are dark`)
    },
  ],
]
