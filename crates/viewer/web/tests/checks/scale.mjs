// The scale beside the part: absolute, on the histogram's axis, and a filter.
import assert from 'node:assert/strict'
import { hex, screen, settled, stageBox } from '../browser.mjs'

const texts = (page) => page.evaluate(() => [...document.querySelectorAll('.chart text.tick')].map((t) => t.textContent))
/** The color at a place of the sphere: near its equator, where it is within tolerance, unless another is given. */
const probe = async (page, [right, down] = [40, 60]) => {
  const box = await stageBox(page)
  return hex((await screen(page)).at(box.cx + right, box.cy + down))
}
/** A place of the sphere near its pole, beyond the tolerance. */
const BEYOND = [0, -100]
/** A link that shows only a range of the sphere. */
const only = (from, to) => {
  const view = { eye: [0.4247, 0.1759, 0.3399, 0.8205, 0, 0, 0, 30], range: [-0.1, 0.1], palette: 'inspect', mode: 'bands', only: [from, to], comparison: 0 }
  return `#v=${encodeURIComponent(JSON.stringify(view))}`
}

const shares = (page) => page.evaluate(() => [...document.querySelectorAll('.chart text.share')].map((t) => t.textContent.replace(/\s/g, '')))

export const scale = [
  [
    'shares are counted: of a hundred points each is a whole number of percent, at any range',
    async (session) => {
      const page = await session.report('few_fit')
      const values = await page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent).maps[0].quantiles)
      assert.equal(values.length, 100)
      for (const range of [null, '0.05', '0.013']) {
        if (range) {
          await page.locator('.controls input[type=text]').fill(range)
          await page.locator('.controls input[type=text]').press('Enter')
        }
        const found = await shares(page)
        assert.ok(found.length > 5)
        for (const text of found) assert.match(text, /^\d+\.0%$/)
        assert.equal(found.reduce((sum, text) => sum + parseFloat(text), 0), 100)
      }
      // Beyond ±0.013 mm, counted here.
      const ends = [values.filter((v) => v > 0.013).length, values.filter((v) => v < -0.013).length]
      assert.deepEqual((await shares(page)).map(parseFloat).filter((_, i, all) => i === 0 || i === all.length - 1).sort(), ends.sort())
    },
  ],
  [
    'shares of many values are counted on the scale as it opens, and marked where they are not counted',
    async (session) => {
      const page = await session.report('sphere')
      const opening = await shares(page)
      assert.ok(opening.length >= 9 && opening.every((text) => !text.includes('≈')), opening.join())
      await page.locator('.controls input[type=text]').fill('0.09')
      await page.locator('.controls input[type=text]').press('Enter')
      const other = await shares(page)
      assert.ok(other.filter((text) => text.startsWith('≈')).length >= 8, other.join())
      // The zone's own share stays the result's.
      assert.ok(other.some((text) => !text.startsWith('≈') && opening.includes(text)), other.join())
    },
  ],
  [
    'filtering and hiding change neither the scale nor the colours that stay',
    async (session) => {
      const page = await session.report('sphere')
      const before = [await texts(page), await probe(page)]
      await page.mouse.move(5, 5)
      const chart = await page.locator('.chart svg').boundingBox()
      await page.mouse.click(chart.x + 60, chart.y + chart.height / 2)
      await settled(page)
      assert.match(await page.locator('.only').innerText(), /33\.7/)
      assert.deepEqual([await texts(page), await probe(page)], before)
      await page.keyboard.press('Escape')
      await page.keyboard.press('n')
      await settled(page)
      assert.deepEqual(await texts(page), before[0])
    },
  ],
  [
    'a new range is a new picture without a byte for the vertices',
    async (session) => {
      const page = await session.report('sphere', {
        init: () => {
          window.uploads = 0
          const upload = WebGL2RenderingContext.prototype.bufferData
          WebGL2RenderingContext.prototype.bufferData = function (target, ...rest) {
            if (target === this.ARRAY_BUFFER || target === this.ELEMENT_ARRAY_BUFFER) window.uploads++
            return upload.call(this, target, ...rest)
          }
        },
      })
      const [before, inside] = [await probe(page, BEYOND), await probe(page)]
      const uploads = await page.evaluate(() => window.uploads)
      assert.ok(uploads > 0)
      const range = page.locator('.controls input[type=text]')
      await range.fill('0.02')
      await range.press('Enter')
      await settled(page)
      assert.notEqual(await probe(page, BEYOND), before)
      // What is within tolerance stays green, however narrow the range.
      assert.equal(await probe(page), inside)
      assert.equal(await page.evaluate(() => window.uploads), uploads)
    },
  ],
  [
    'the bars and what lies beyond are all points, each bar at its value',
    async (session) => {
      for (const name of ['sphere', 'missing', 'free']) {
        const page = await session.report(name)
        const found = await page.evaluate(() => {
          const chart = document.querySelector('.chart svg')
          const bars = [...chart.querySelectorAll('.bar')].map((b) => ({ ...b.dataset, y: Number(b.getAttribute('y')), h: Number(b.getAttribute('height')) }))
          const ticks = [...chart.querySelectorAll('text.tick')].map((t) => [Number(t.textContent.replace('\u2212', '-')), Number(t.getAttribute('y'))])
          const manifest = JSON.parse(document.getElementById('manifest').textContent)
          return { bars, ticks, beyond: Number(chart.dataset.below) + Number(chart.dataset.above), count: manifest.result.comparisons[0].deviation.all.count, limits: manifest.result.scale }
        })
        const sum = found.bars.reduce((n, b) => n + Number(b.count), 0)
        assert.equal(sum + found.beyond, found.count)
        const [low, high] = [found.ticks.find(([v]) => v === found.limits.lower), found.ticks.find(([v]) => v === found.limits.upper)]
        const at = (v) => low[1] + ((v - low[0]) / (high[0] - low[0])) * (high[1] - low[1])
        for (const b of found.bars) {
          assert.ok(Math.abs(b.y - at(Number(b.to))) <= 1, `${name}: ${b.to}`)
          assert.ok(Math.abs(b.y + b.h - at(Number(b.from))) <= 1, `${name}: ${b.from}`)
        }
      }
    },
  ],
  [
    'a range keeps its colours, the rest is grey, and its share is named',
    async (session) => {
      const page = await session.report('sphere', { hash: only(0.05, 0.1) })
      const share = Number(/([\d.]+)\s*%/.exec(await page.locator('.only strong').innerText())[1])
      // Rings of equal angle: those from the pole to 60 degrees, with one pole, of 39,802 vertices.
      assert.ok(Math.abs(share - 100 * ((67 * 200 + 1 - 200) / 39802)) <= 0.6, `${share}`)
      await page.keyboard.press('l')
      await page.keyboard.press('1')
      await settled(page)
      const box = await stageBox(page)
      const picture = await screen(page)
      const grey = (c) => Math.max(...c) - Math.min(...c) < 12
      assert.ok(grey(picture.at(box.cx - 30, box.cy)), 'outside of the range')
      assert.ok(grey(picture.at(box.cx - 30, box.cy + box.height * 0.3)), 'on the other side')
      assert.ok(!grey(picture.at(box.cx - 30, box.cy - box.height * 0.3)), 'inside of the range')
    },
  ],
]
