// What a page from somebody else must never do, and what it must do with nothing but HTML.
import assert from 'node:assert/strict'
import { statSync } from 'node:fs'
import { join } from 'node:path'
import { settled, stageBox } from '../browser.mjs'

export const trust = [
  [
    'no request, no error, no violation of the policy',
    async (session) => {
      const page = await session.report('sphere')
      const foreign = page.seen.requests.filter((url) => !url.endsWith('/sphere.html') && !/^(blob|data):/.test(url))
      assert.deepEqual(foreign, [])
      assert.deepEqual(page.seen.errors, [])
      assert.deepEqual(await page.evaluate(() => window.violations), [])
    },
  ],
  [
    'with scripts off: verdict, statistics, figure, picture, files',
    async (session) => {
      const page = await session.report('sphere', { scripts: false })
      const text = await page.locator('body').innerText()
      for (const part of ['Fail', '33.67', 'Standard deviation', '0.0705', 'pseudonormal', '3f3f3f', 'sphere.stl']) assert.ok(text.includes(part), part)
      const picture = page.locator('#picture')
      assert.ok(await picture.evaluate((img) => img.complete && img.naturalWidth === 1200))
      const [a, b] = [await picture.boundingBox(), await page.locator('#figure').boundingBox()]
      assert.ok(a.height > 200 && b.height > 60 && a.y + a.height <= b.y + 1)
    },
  ],
  [
    'names from files are text, whatever they hold',
    async (session) => {
      const page = await session.report('hostile')
      assert.equal(page.seen.dialogs, 0)
      assert.equal(await page.locator('img').count(), 1)
      assert.equal(await page.locator('[onerror], [onload]').count(), 0)
      const name = page.locator('.file bdi.name').first()
      assert.ok((await name.textContent()).includes('<img src=x onerror=alert(1)>'))
      assert.ok((await name.boundingBox()).width < 320)
      assert.ok(await page.evaluate(() => document.body.scrollWidth <= document.body.clientWidth))
      assert.deepEqual(page.seen.errors, [])
    },
  ],
  [
    'a million vertices: the file is small, the part comes up, and it rests',
    async (session) => {
      const size = statSync(join(session.folder, 'million.html')).size
      assert.ok(size <= 10e6, `${size} bytes`)
      const count = () => {
        window.draws = 0
        const draw = WebGL2RenderingContext.prototype.drawElements
        WebGL2RenderingContext.prototype.drawElements = function (...a) {
          window.draws++
          return draw.apply(this, a)
        }
      }
      const page = await session.report('million', { init: count })
      const before = await page.evaluate(() => window.draws)
      await page.waitForTimeout(1000)
      assert.equal(await page.evaluate(() => window.draws), before)
    },
  ],
  [
    'without WebGL the stored picture stays, with the reason',
    async (session) => {
      const page = await session.report('sphere', {
        live: false,
        init: () => {
          HTMLCanvasElement.prototype.getContext = () => null
        },
      })
      await page.waitForSelector('.notice[data-t="stage.none"]')
      assert.ok(await page.locator('#picture').isVisible())
      assert.ok((await page.locator('.chart').boundingBox()).height > 100)
    },
  ],
  [
    'a lost context is announced and comes back with the same view',
    async (session) => {
      const page = await session.report('sphere')
      await page.keyboard.press('1')
      await settled(page)
      const eye = () => page.waitForTimeout(700).then(() => page.evaluate(() => location.hash))
      const before = await eye()
      await page.evaluate(() => {
        window.lose = document.querySelector('canvas').getContext('webgl2').getExtension('WEBGL_lose_context')
        window.lose.loseContext()
      })
      await page.waitForSelector('.notice[data-t="stage.lost"]:not([hidden])')
      await page.evaluate(() => window.lose.restoreContext())
      await page.waitForSelector('.notice[hidden]', { state: 'attached' })
      await settled(page)
      assert.equal(await eye(), before)
      const box = await stageBox(page)
      await page.mouse.move(box.cx, box.cy)
      await page.waitForSelector('.hover:not([hidden])')
    },
  ],
]
