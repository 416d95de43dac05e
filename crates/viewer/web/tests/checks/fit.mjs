// An element through points: its values, its body, what holds it.
import assert from 'node:assert/strict'
import { hex, near, screen, settled, stageBox } from '../browser.mjs'

const CHOSEN = [0xff, 0xe0, 0x00]

export const fit = [
  [
    'points are coloured by their distance, which the cursor reads through the body',
    async (session) => {
      const page = await session.report('fit')
      await page.keyboard.press('1')
      await settled(page)
      const box = await stageBox(page)
      // The highest lobe is in front: points of one ring lie every 3 degrees, rings every 0.75 mm.
      const value = await page.evaluate(async ([cx, cy]) => {
        const canvas = document.querySelector('canvas')
        for (let dx = 0; dx < 40; dx++)
          for (let dy = 0; dy < 20; dy++) {
            canvas.dispatchEvent(new PointerEvent('pointermove', { clientX: cx + dx, clientY: cy + dy }))
            const read = document.getElementById('readout').dataset.value
            if (read) return [Number(read), dx]
          }
        return null
      }, [box.cx, box.cy])
      assert.ok(value, 'no point is read near the middle')
      assert.ok(value[0] > 0.085 && value[0] < 0.1001, `${value}`)
    },
  ],
  [
    'the body is looked through, and N takes it away',
    async (session) => {
      const page = await session.report('fit')
      await page.keyboard.press('a')
      await page.keyboard.press('1')
      await settled(page)
      const box = await stageBox(page)
      const middle = async () => (await screen(page)).at(box.cx + 3, box.cy + 7)
      const ground = (await screen(page)).at(box.x + 6, box.y + box.height - 6)
      const body = await middle()
      assert.ok(body[2] > body[0] + 15, `${hex(body)} is not blue`)
      await page.keyboard.press('n')
      await settled(page)
      assert.ok(near(await middle(), ground, 2), 'nothing is left')
    },
  ],
  [
    'the bars are all points, and the scale says which side is above zero',
    async (session) => {
      const page = await session.report('fit')
      const found = await page.evaluate(() => {
        const chart = document.querySelector('.chart svg')
        const bars = [...chart.querySelectorAll('.bar')].reduce((n, b) => n + Number(b.dataset.count), 0)
        return bars + Number(chart.dataset.below) + Number(chart.dataset.above)
      })
      assert.equal(found, 41 * 120)
      assert.match(await page.locator('.scale').innerText(), /on the outer side/)
    },
  ],
  [
    'touching points of a minimum zone: a row leads to each',
    async (session) => {
      const page = await session.report('zone', { reducedMotion: 'reduce' })
      const rows = page.locator('.b-touching tr[data-pick]')
      const count = await page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent).result.touching.length)
      assert.ok(count >= 4)
      assert.equal(await rows.count(), count)
      await rows.nth(1).click()
      await settled(page)
      const box = await stageBox(page)
      assert.ok(near((await screen(page)).at(box.cx, box.cy), CHOSEN, 12), 'the dot is in the middle')
    },
  ],
  [
    'with scripts off: the parameters with their uncertainties',
    async (session) => {
      const page = await session.report('fit', { scripts: false })
      const text = await page.locator('.parameters').innerText()
      assert.match(text, /Radius\s+10\.000/)
      assert.match(text, /uncertainty/)
      assert.match(await page.locator('h1').innerText(), /Cylinder/)
    },
  ],
]
