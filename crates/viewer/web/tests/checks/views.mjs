// Getting about, and paper.
import assert from 'node:assert/strict'
import { hex, screen, settled, stageBox, tool } from '../browser.mjs'
import { view } from './colors.mjs'

export const views = [
  [
    'fit: the cube is a square in six views and fills the stage',
    async (session) => {
      const page = await session.report('cube')
      await tool(page, 'Flags')
      for (const key of ['1', '2', '3', '4', '5', '6']) {
        await page.keyboard.press(key)
        await settled(page)
        const box = await stageBox(page)
        const picture = await screen(page)
        const ground = hex(picture.at(box.x + 12, box.cy))
        const run = (dx, dy) => {
          let n = 0
          while (n < 2000 && hex(picture.at(box.cx + n * dx, box.cy + n * dy)) !== ground) n++
          return n
        }
        const [w, h] = [run(1, 0) + run(-1, 0), run(0, 1) + run(0, -1)]
        assert.ok(Math.abs(w - h) <= 2, `view ${key}: ${w} × ${h}`)
        const share = h / Math.min(box.width, box.height)
        assert.ok(share > 0.7 && share < 0.9, `view ${key}: ${share}`)
      }
    },
  ],
  [
    'the wheel zooms to the cursor, the drag turns about what it holds',
    async (session) => {
      const page = await session.report('sphere')
      await page.keyboard.press('1')
      await settled(page)
      const box = await stageBox(page)
      const spot = [Math.round(box.cx + 80), Math.round(box.cy - 60)]
      const read = async () => {
        await page.mouse.move(spot[0] + 1, spot[1])
        await page.mouse.move(...spot)
        return Number(await page.evaluate(() => document.getElementById('readout').dataset.value))
      }
      const [before, height] = [await read(), await view(page)]
      await page.mouse.wheel(0, -300)
      await settled(page)
      assert.ok(Math.abs((await read()) - before) < 1e-4)
      assert.ok((await view(page)) < 0.7 * height)
      await page.mouse.down()
      await page.mouse.move(spot[0] + 40, spot[1] + 5, { steps: 4 })
      await page.mouse.up()
      await settled(page)
      await page.mouse.move(5, 5)
      assert.ok(Math.abs((await read()) - before) < 2e-3, 'the point held is still under the cursor')
    },
  ],
  [
    'keyboard alone: every control can be reached and shows it',
    async (session) => {
      const page = await session.report('sphere')
      const reached = new Set()
      for (let i = 0; i < 60; i++) {
        await page.keyboard.press('Tab')
        const at = await page.evaluate(() => {
          const e = document.activeElement
          const visible = getComputedStyle(e).outlineStyle !== 'none'
          return { name: e.dataset.pick ? `place ${e.dataset.pick}` : e.tagName + (e.dataset.view ?? e.dataset.flag ?? e.dataset.key ?? ''), visible, body: e === document.body }
        })
        if (at.body) break
        assert.ok(at.visible, `${at.name} shows no focus`)
        reached.add(at.name)
      }
      for (const name of ['place 0', 'CANVAS', 'BUTTONtop', 'BUTTON0', 'BUTTONtool.print']) assert.ok(reached.has(name), `${name} in ${[...reached]}`)
    },
  ],
  [
    'paper: light, the verdict, the picture and all tables, no piece of the screen',
    async (session) => {
      const page = await session.report('sphere', { colorScheme: 'dark', width: 800, height: 1100 })
      const pdf = await page.pdf({ format: 'A4', printBackground: true })
      const pages = pdf.toString('latin1').match(/\/Type\s*\/Page\b/g).length
      assert.ok(pages >= 2 && pages <= 4, `${pages} pages`)
      await page.emulateMedia({ media: 'print' })
      for (const css of ['.verdict', '#picture', '#figure', '.statistics', '.hash']) assert.ok(await page.locator(css).first().isVisible(), css)
      for (const css of ['.overlay', '#scale', 'canvas', '#tools']) assert.ok(!(await page.locator(css).first().isVisible()), css)
      await page.evaluate(() => window.dispatchEvent(new Event('beforeprint')))
      await page.waitForFunction(() => document.getElementById('picture').complete)
      const box = await page.locator('#picture').boundingBox()
      const picture = await screen(page)
      const middle = picture.at(box.x + box.width / 2, box.y + box.height / 2)
      assert.ok(Math.max(...middle) - Math.min(...middle) > 40, `blank: ${hex(middle)}`)
      assert.equal(hex(picture.at(2, 2)) === '#c11f2b' || hex(picture.at(2, 60)) === '#ffffff', true)
    },
  ],
]
