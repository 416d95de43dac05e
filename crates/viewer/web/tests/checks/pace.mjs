// How much is drawn, and when: coarse from the first frame of a movement, in full at rest, then nothing.
import assert from 'node:assert/strict'
import { settled, stageBox } from '../browser.mjs'

/** Triangles of every frame. */
const count = () => {
  window.frames = []
  let open = 0
  const draw = WebGL2RenderingContext.prototype.drawElements
  WebGL2RenderingContext.prototype.drawElements = function (mode, n, ...rest) {
    if (open === 0) queueMicrotask(() => (window.frames.push(open), (open = 0)))
    open += n / 3
    return draw.call(this, mode, n, ...rest)
  }
}

export const pace = [
  [
    'turning draws the coarse level from the first frame, rest the full one, and then nothing',
    async (session) => {
      const page = await session.report('million', { init: count })
      const full = await page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent).objects[0].triangles)
      const box = await stageBox(page)
      await page.mouse.move(box.cx, box.cy)
      await page.mouse.down()
      await page.evaluate(() => (window.frames.length = 0))
      for (let k = 0; k < 6; k++) await page.mouse.move(box.cx + 12 * k, box.cy + 5 * k)
      const moving = await page.evaluate(() => window.frames.slice())
      await page.mouse.up()
      assert.ok(moving.length > 0)
      assert.ok(moving[0] < 0.05 * full, `${moving}`)
      // A machine that is fast enough may have come to finer levels by now, one level at a time.
      assert.ok(moving.every((n, i) => i === 0 || n <= 20 * moving[i - 1]), `${moving}`)
      await settled(page)
      const after = await page.evaluate(() => window.frames.slice())
      assert.ok(after.slice(-2).every((n) => n > 0.9 * full), 'the picture in full, then its values')
      await page.waitForTimeout(1000)
      assert.equal(await page.evaluate(() => window.frames.length), after.length)
    },
  ],
  [
    'a slow frame is no pause of the hand: nothing is drawn in full between two',
    async (session) => {
      // Every frame takes a third of a second here, longer than the pause after which a still picture is drawn in full.
      const slow = () => {
        const wait = WebGL2RenderingContext.prototype.clientWaitSync
        const since = new WeakMap()
        WebGL2RenderingContext.prototype.clientWaitSync = function (sync, ...rest) {
          if (!since.has(sync)) since.set(sync, performance.now())
          return window.slow && performance.now() - since.get(sync) < 330 ? this.TIMEOUT_EXPIRED : wait.call(this, sync, ...rest)
        }
      }
      const page = await session.report('million', { init: `(${count})();(${slow})()` })
      await page.evaluate(() => (window.slow = true))
      const frames = await page.evaluate(async () => {
        const canvas = document.querySelector('canvas')
        window.frames.length = 0
        // The next key comes when the frame before is finished, as it does on a busy machine.
        for (let k = 0; k < 6; k++) {
          const before = window.frames.length
          canvas.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft', ctrlKey: true }))
          while (window.frames.length === before) await new Promise((done) => setTimeout(done, 5))
          await new Promise((done) => setTimeout(done, 300))
        }
        return window.frames.slice()
      })
      assert.ok(frames.length >= 6 && frames.every((n) => n < 100_000), `${frames}`)
    },
  ],
  [
    'the cursor moves a mark on the scale and draws nothing else of it anew',
    async (session) => {
      const page = await session.report('sphere')
      await page.keyboard.press('1')
      await settled(page)
      const box = await stageBox(page)
      await page.evaluate(() => {
        window.changed = 0
        new MutationObserver((all) => (window.changed += all.reduce((n, m) => n + m.addedNodes.length, 0))).observe(document.querySelector('.chart svg'), { childList: true, subtree: true })
      })
      for (let k = 1; k <= 10; k++) await page.mouse.move(box.cx, box.cy - 60 + 12 * k)
      const changed = await page.evaluate(() => window.changed)
      assert.ok(changed >= 5 && changed <= 10, `${changed} elements for ten movements`)
      assert.equal(await page.locator('.chart .hover').count(), 1)
    },
  ],
]
