// A repair: before and after in one place, and the way to each change.
import assert from 'node:assert/strict'
import { hex, near, screen, settled, stageBox } from '../browser.mjs'

export const repair = [
  [
    'N swaps before and after: a hole with its inner side, then green facets',
    async (session) => {
      const page = await session.report('mended', { reducedMotion: 'reduce' })
      const hole = await page.evaluate(() => {
        const kind = [...document.querySelectorAll('.kind')].find((k) => k.querySelector('.kind-name').textContent === 'Holes filled')
        const row = kind.querySelector('tr[data-pick]')
        row.click()
        return Number(row.dataset.pick)
      })
      assert.ok(hole >= 0)
      await page.keyboard.press('d')
      await settled(page)
      const box = await stageBox(page)
      const middle = async () => (await screen(page)).at(box.cx + 9, box.cy + 6)
      const after = await middle()
      assert.ok(after[1] > after[0] + 25, `${hex(after)} is not green`)
      await page.keyboard.press('n')
      await settled(page)
      const before = await middle()
      assert.ok(!near(after, before, 20) && before[0] > before[1], `${hex(before)} is no inner side`)
      await page.keyboard.press('n')
      await settled(page)
      assert.ok(near(await middle(), after, 2))
    },
  ],
  [
    'with scripts off: what was changed, before and after',
    async (session) => {
      const page = await session.report('mended', { scripts: false })
      assert.match(await page.locator('h1').innerText(), /Repaired: sound/)
      const text = await page.locator('.states').innerText()
      assert.match(text, /Holes\s+1\s+0/)
      assert.match(await page.locator('.kind summary').allInnerTexts().then((t) => t.join(' ')), /Holes filled\s+1/)
    },
  ],
]
