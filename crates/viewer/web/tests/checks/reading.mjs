// What the cursor reads, and the flags at the worst places.
import assert from 'node:assert/strict'
import { settled, stageBox } from '../browser.mjs'
import { view } from './colors.mjs'

const value = (page) => page.evaluate(() => document.getElementById('readout').dataset.value)
const line = (page) => page.evaluate(() => document.getElementById('readout').textContent)

/** Leader lines and boxes of the flags, relative to the stage. */
const flags = (page) =>
  page.evaluate(() => {
    const stage = document.querySelector('#stage').getBoundingClientRect()
    const number = (e, name) => Number(e.getAttribute(name))
    const leaders = [...document.querySelectorAll('.leaders .leader')].map((l) => ({ x1: number(l, 'x1'), y1: number(l, 'y1'), x2: number(l, 'x2'), y2: number(l, 'y2'), hidden: l.classList.contains('hidden') }))
    const boxes = [...document.querySelectorAll('.flag')].map((f) => {
      const b = f.getBoundingClientRect()
      return { x: b.x - stage.x, y: b.y - stage.y, w: b.width, h: b.height, text: f.textContent }
    })
    return { leaders, boxes }
  })

function crossing(a, b) {
  const side = (p, q, r) => Math.sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))
  const [p, q, r, s] = [[a.x1, a.y1], [a.x2, a.y2], [b.x1, b.y1], [b.x2, b.y2]]
  return side(p, q, r) * side(p, q, s) < 0 && side(r, s, p) * side(r, s, q) < 0
}

export const reading = [
  [
    'the cursor reads the value that is drawn: sphere, twenty places',
    async (session) => {
      const page = await session.report('sphere')
      await page.keyboard.press('1')
      await settled(page)
      const height = await view(page)
      const box = await stageBox(page)
      const scale = height / box.height
      for (let i = 0; i < 20; i++) {
        const [x, z] = [8 * Math.cos(i * 2.4) * Math.sqrt(i / 20), 8 * Math.sin(i * 2.4) * Math.sqrt(i / 20)]
        const [px, py] = [Math.round(box.cx + x / scale), Math.round(box.cy - z / scale)]
        await page.mouse.move(px, py)
        const got = Number(await value(page))
        // The middle of the row of pixels that the cursor is in.
        const row = box.y + Math.floor(py - box.y) + 0.5
        const want = 0.01 * (box.cy - row) * scale
        // Facets lie within 0.0013 mm of the sphere; the view's numbers have seven digits.
        assert.ok(Math.abs(got - want) < 2e-5, `${got} is not ${want} at ${x}, ${z}`)
      }
      await page.mouse.move(box.x + 30, box.y + box.height - 20)
      assert.equal(await line(page), '')
    },
  ],
  [
    'where there is no value the cursor says why',
    async (session) => {
      const page = await session.report('missing')
      await page.keyboard.press('2')
      await settled(page)
      const box = await stageBox(page)
      await page.mouse.move(box.cx, box.cy)
      assert.match(await line(page), /No value · beyond the maximum distance/)
    },
  ],
  [
    'flags: at their places, apart, leaders without crossings, dashed where hidden',
    async (session) => {
      const page = await session.report('sphere')
      await page.keyboard.press('5')
      await settled(page)
      const top = await flags(page)
      const box = await stageBox(page)
      assert.equal(top.boxes.length, 6)
      assert.match(top.boxes[0].text, /\+0\.100/)
      assert.ok(Math.hypot(top.leaders[0].x2 - box.width / 2, top.leaders[0].y2 - box.height / 2) <= 1, 'the pole is in the middle')
      assert.deepEqual(top.leaders.map((l) => l.hidden), [false, false, false, true, true, true])
      for (const view of ['5', '7', '1']) {
        await page.keyboard.press(view)
        await settled(page)
        const { leaders, boxes } = await flags(page)
        for (let i = 0; i < 6; i++)
          for (let j = i + 1; j < 6; j++) {
            const [a, b] = [boxes[i], boxes[j]]
            assert.ok(a.x + a.w <= b.x || b.x + b.w <= a.x || a.y + a.h <= b.y || b.y + b.h <= a.y, `view ${view}: ${i} over ${j}`)
            assert.ok(!crossing(leaders[i], leaders[j]), `view ${view}: leaders ${i} and ${j} cross`)
          }
      }
    },
  ],
  [
    'a row of the list brings its place to the middle, and J goes on',
    async (session) => {
      const page = await session.report('sphere')
      await page.locator('.comparison:not([hidden]) tr[data-pick="4"]').click()
      await settled(page)
      const box = await stageBox(page)
      const at = (await flags(page)).leaders[4]
      assert.ok(Math.hypot(at.x2 - box.width / 2, at.y2 - box.height / 2) < 1)
      await page.keyboard.press('j')
      assert.equal(await page.locator('tr[aria-selected="true"]').getAttribute('data-pick'), '5')
    },
  ],
  [
    'several references: choosing one changes numbers, map and flags, not the scale',
    async (session) => {
      const page = await session.report('two')
      const ticks = () => page.evaluate(() => [...document.querySelectorAll('.chart text.tick')].map((t) => t.textContent).join())
      const before = [await ticks(), await page.locator('#numbers').innerText()]
      await page.locator('tr[data-choose="1"]').click()
      await settled(page)
      assert.equal(await ticks(), before[0])
      assert.notEqual(await page.locator('#numbers').innerText(), before[1])
      await page.keyboard.press('4')
      await settled(page)
      const box = await stageBox(page)
      await page.mouse.move(Math.round(box.cx), Math.round(box.cy))
      assert.ok(Math.abs(Number(await value(page)) - 0.22) < 1e-3)
    },
  ],
]
