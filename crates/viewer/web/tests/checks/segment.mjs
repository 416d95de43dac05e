// Elements found in a part: each in the list and on the part in one color.
import assert from 'node:assert/strict'
import { screen, settled, stageBox } from '../browser.mjs'

const manifest = (page) => page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent))
const bytes = (color) => [1, 3, 5].map((k) => parseInt(color.slice(k, k + 2), 16))
/** Color of the rim of what is chosen. */
const CHOSEN = 53

/** Hue in degrees; null for what is nearly gray. */
function hue([r, g, b]) {
  const [most, least] = [Math.max(r, g, b), Math.min(r, g, b)]
  if (most - least < 60) return null
  const [from, second] = most === r ? [0, g - b] : most === g ? [120, b - r] : [240, r - g]
  return (from + (60 * second) / (most - least) + 360) % 360
}
const apart = (a, b) => Math.min((a - b + 360) % 360, (b - a + 360) % 360)

/** Pixels of the stage with each of the colors, and the number of those with another; light and shade do not count. */
async function painted(page, colors) {
  const box = await stageBox(page)
  const picture = await screen(page)
  const hues = colors.map(hue)
  const found = { each: colors.map(() => 0), other: 0 }
  // Below the buttons.
  for (let y = Math.ceil(box.y) + 48; y < box.y + box.height - 8; y += 2)
    for (let x = Math.ceil(box.x) + 8; x < box.x + box.width - 8; x += 2) {
      const h = hue(picture.at(x, y))
      if (h === null || apart(h, CHOSEN) < 12) continue
      const nearest = hues.findIndex((mine) => apart(mine, h) < 12)
      if (nearest < 0) found.other++
      else found.each[nearest]++
    }
  return found
}

const rows = (page) =>
  page.evaluate(() =>
    [...document.querySelectorAll('tr[data-pick]')].map((row) => ({
      pick: Number(row.dataset.pick),
      color: row.querySelector('.swatch rect').getAttribute('fill'),
      text: row.textContent,
    })),
  )

export const segment = [
  [
    'every element is listed in the colour that it has on the part',
    async (session) => {
      const page = await session.report('elements', { reducedMotion: 'reduce' })
      const { result, picks, objects } = await manifest(page)
      const listed = await rows(page)
      assert.equal(listed.length, result.regions.length)
      assert.deepEqual(result.regions.map((r) => r.shape).toSorted(), ['cone', 'cylinder', 'plane', 'sphere'])
      const colors = listed.map((row) => row.color)
      assert.equal(new Set(colors).size, colors.length)
      for (const { pick, color } of listed) {
        const object = objects.find((o) => o.id === picks[pick].object)
        assert.equal(`#${object.color}`, color)
      }
      // The foot is seen from below only.
      await page.keyboard.press('2')
      await settled(page)
      const front = (await painted(page, colors.map(bytes))).each
      result.regions.forEach((r, n) => assert.ok(r.shape === 'plane' || front[n] > 200, `${r.shape}: ${front[n]} pixels`))
      assert.deepEqual(page.seen.errors, [])
    },
  ],
  [
    'a chosen element alone keeps its colour, Escape gives all of them back',
    async (session) => {
      const page = await session.report('elements', { reducedMotion: 'reduce' })
      const listed = await rows(page)
      const colors = listed.map((row) => bytes(row.color))
      for (const [n, { pick, text }] of listed.entries()) {
        await page.evaluate((k) => document.querySelector(`tr[data-pick="${k}"]`).click(), pick)
        await settled(page)
        assert.equal(await page.locator('tr[aria-selected=true]').getAttribute('data-pick'), String(pick))
        const { each, other } = await painted(page, colors)
        assert.ok(each[n] > 400, `${text}: ${each[n]} pixels`)
        const rest = other + each.reduce((sum, count, k) => (k === n ? sum : sum + count), 0)
        assert.ok(rest <= 0.02 * each[n], `${text}: ${each}, others ${other}`)
      }
      await page.locator('canvas').focus()
      await page.keyboard.press('Escape')
      await settled(page)
      assert.equal(await page.locator('tr[aria-selected=true]').count(), 0)
      const { each } = await painted(page, colors)
      assert.ok(each.filter((count) => count > 200).length >= 2, `${each}`)
      assert.deepEqual(page.seen.errors, [])
    },
  ],
  [
    'edges behind the part are hidden by it, on the stage and in the stored picture',
    async (session) => {
      for (const scripts of [true, false]) {
        const page = await session.report('elements', { scripts })
        const { objects } = JSON.parse(await page.locator('#manifest').textContent())
        const box = await page.locator('#stage').boundingBox()
        const picture = await screen(page)
        const x = Math.round(box.x + box.width / 2) + 20
        const shaft = bytes(`#${objects.find((o) => o.name === 'cylinder')?.color ?? objects[0].color}`)
        const column = Array.from({ length: Math.floor(box.height) }, (_, y) => picture.at(x, box.y + y))
        const own = column.flatMap((c, y) => (hue(c) !== null && apart(hue(c), hue(shaft)) < 8 ? [y] : []))
        assert.ok(own.length > 60, `${own.length} pixels of the shaft`)
        // From its first pixel to its last the shaft is one color: no line runs behind it.
        const inside = column.slice(own[0] + 6, own.at(-1) - 5)
        const spread = [0, 1, 2].map((k) => Math.max(...inside.map((c) => c[k])) - Math.min(...inside.map((c) => c[k])))
        assert.ok(Math.max(...spread) < 16, `scripts ${scripts}: ${spread}`)
      }
    },
  ],
  [
    'with scripts off: the elements with their sizes',
    async (session) => {
      const page = await session.report('elements', { scripts: false })
      assert.match(await page.locator('table.pick').innerText(), /Cylinder\s+r\s+10\.000/)
      assert.match(await page.locator('table.pick').innerText(), /Sphere\s+r\s+8\.000/)
    },
  ],
]
