// The color on the part is the color on the scale, at the pixel.
import assert from 'node:assert/strict'
import { hex, near, screen, settled, stageBox, tool } from '../browser.mjs'

const GREEN = [0x2f, 0xa8, 0x4a]
const HIGH_CAP = [0x65, 0x08, 0x12]
const LAST_BAND = [0xd3, 0x20, 0x1f]
const key = async (page, k) => {
  await page.keyboard.press(k)
  await settled(page)
}
/** Color in the middle of the stage, seen in a standard view without light. */
const middle = async (page, view) => {
  await key(page, view)
  const box = await stageBox(page)
  return (await screen(page)).at(box.cx, box.cy)
}
/** Color of the scale's strip at a deviation. */
const legend = (page, value) =>
  page.evaluate((value) => {
    const bars = [...document.querySelectorAll('.chart .bar')]
    void bars
    const chart = document.querySelector('.chart svg')
    const box = chart.getBoundingClientRect()
    const ticks = [...chart.querySelectorAll('text.tick')].map((t) => [Number(t.textContent.replace('\u2212', '-').replace('+', '')), Number(t.getAttribute('y'))])
    const [low, high] = [ticks.reduce((a, b) => (a[0] < b[0] ? a : b)), ticks.reduce((a, b) => (a[0] > b[0] ? a : b))]
    const y = low[1] + ((value - low[0]) / (high[0] - low[0])) * (high[1] - low[1])
    const band = [...chart.querySelectorAll('.band')].find((r) => {
      const top = Number(r.getAttribute('y'))
      return y >= top && y <= top + Number(r.getAttribute('height'))
    })
    void box
    const c = band.getAttribute('fill')
    return [1, 3, 5].map((k) => parseInt(c.slice(k, k + 2), 16))
  }, value)

export const colors = [
  [
    'flat colours equal the scale: cube, each face',
    async (session) => {
      const page = await session.report('cube')
      await tool(page, 'Flat')
      for (const [view, value] of [['4', 0.19999], ['1', -0.15 + 1e-4], ['2', 0], ['3', 0]]) {
        const [got, want] = [await middle(page, view), await legend(page, value)]
        assert.ok(near(got, want, 2), `view ${view}: ${hex(got)} is not ${hex(want)}`)
      }
    },
  ],
  [
    'a value on the tolerance limit is green, a step beyond it is not',
    async (session) => {
      const page = await session.report('cube')
      await tool(page, 'Flat')
      assert.ok(near(await middle(page, '5'), GREEN, 2))
      assert.ok(!near(await middle(page, '6'), GREEN, 20))
    },
  ],
  [
    'beyond the scale is the cap, not the last band',
    async (session) => {
      const page = await session.report('cube')
      await tool(page, 'Flat')
      assert.ok(near(await middle(page, '4'), LAST_BAND, 2), 'on the upper end')
      const range = page.locator('.controls input[type=text]')
      await range.fill('0,15')
      await range.press('Enter')
      await page.locator('canvas').focus()
      assert.ok(near(await middle(page, '4'), HIGH_CAP, 2), 'beyond it')
    },
  ],
  [
    'within tolerance is green, however narrow the range and however smooth the colours',
    async (session) => {
      const page = await session.report('cube')
      await tool(page, 'Flat')
      const range = page.locator('.controls input[type=text]')
      await range.fill('0,01')
      await range.press('Enter')
      for (const mode of ['bands', 'continuous']) {
        await page.locator('.controls select').first().selectOption(mode)
        await page.locator('canvas').focus()
        for (const view of ['5', '2', '3']) assert.ok(near(await middle(page, view), GREEN, 2), `${mode}, view ${view}`)
        assert.ok(!near(await middle(page, '4'), GREEN, 20) && !near(await middle(page, '6'), GREEN, 20), mode)
        const bars = await page.evaluate(() => [...document.querySelectorAll('.chart .bar')].map((b) => [Number(b.dataset.from), Number(b.dataset.to), b.getAttribute('fill')]))
        for (const [from, to, fill] of bars) assert.equal(fill === '#2fa84a', Math.abs((from + to) / 2) <= 0.1, `${mode}: bar from ${from}`)
      }
    },
  ],
  [
    'no value is grey and hatched',
    async (session) => {
      const page = await session.report('missing')
      await tool(page, 'Flat')
      await key(page, '2')
      const box = await stageBox(page)
      const picture = await screen(page)
      const seen = new Set()
      for (let i = 0; i < 12; i++) for (let j = 0; j < 12; j++) seen.add(hex(picture.at(box.cx + i, box.cy + j)))
      assert.ok(seen.has('#9aa0a6') && seen.size >= 2, [...seen].join(' '))
    },
  ],
  [
    'a flat face has one shade: no dents where a coarse mesh has none',
    async (session) => {
      const page = await session.report('box')
      for (const turns of [0, 1, 2]) {
        if (turns > 0) await key(page, 'ArrowRight')
        const box = await stageBox(page)
        const picture = await screen(page)
        // Along lines over the part: three faces, so few shades; each change from one to the next is an edge.
        const shades = new Map()
        for (let i = -24; i <= 24; i++)
          for (let j = -24; j <= 24; j++) {
            const c = hex(picture.at(box.cx + 4 * i, box.cy + 4 * j))
            shades.set(c, (shades.get(c) ?? 0) + 1)
          }
        const often = [...shades.values()].sort((a, b) => b - a)
        const three = often.slice(0, 3).reduce((a, b) => a + b, 0) / (49 * 49)
        assert.ok(three > 0.95, `turned ${turns}: three shades are ${three} of the part, of ${shades.size}`)
      }
    },
  ],
  [
    'measured and reference shown together: the measured is seen where both are the same',
    async (session) => {
      const page = await session.report('box')
      const before = await screen(page)
      await key(page, 'n')
      const after = await screen(page)
      const box = await stageBox(page)
      for (let i = -24; i <= 24; i++)
        for (let j = -24; j <= 24; j++) {
          const [x, y] = [box.cx + 5 * i, box.cy + 5 * j]
          assert.ok(near(before.at(x, y), after.at(x, y), 3), `${x}, ${y}: ${hex(before.at(x, y))} became ${hex(after.at(x, y))}`)
        }
    },
  ],
  [
    'band edges are iso-lines: sphere, along the meridian',
    async (session) => {
      const page = await session.report('sphere')
      await tool(page, 'Flat')
      await key(page, '1')
      const box = await stageBox(page)
      const picture = await screen(page)
      const height = await view(page)
      const pixelOf = (value) => box.cy - ((value / 0.01) * box.height) / height
      // Beside the leaders and off the middle, where the flags' anchors lie.
      const x = box.cx - 30
      for (const limit of [0.05, 0.0625, 0.075, -0.05, -0.0625]) {
        // On this line z is what it is in the middle: the view is orthographic.
        const y = pixelOf(limit)
        const outward = Math.sign(-limit)
        const [inside, outside] = [picture.at(x, Math.floor(y - 2 * outward)), picture.at(x, Math.floor(y + 2 * outward))]
        assert.notEqual(hex(inside), hex(outside), `no edge at ${limit}`)
        for (const d of [3, 4, 5]) {
          assert.equal(hex(picture.at(x, Math.floor(y - d * outward))), hex(inside))
          assert.equal(hex(picture.at(x, Math.floor(y + d * outward))), hex(outside))
        }
      }
    },
  ],
]

/** Millimeters from the stage's foot to its top, from the link that the page keeps. */
export async function view(page) {
  await page.waitForFunction(() => location.hash.startsWith('#v='))
  await page.waitForTimeout(700)
  const link = await page.evaluate(() => decodeURIComponent(location.hash.slice(3)))
  return JSON.parse(link).eye[7]
}
