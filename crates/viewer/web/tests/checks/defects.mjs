// What a check found: in the list, on the part, and from one to the other.
import assert from 'node:assert/strict'
import { hex, near, screen, settled, stageBox } from '../browser.mjs'

const CHOSEN = [0xff, 0xe0, 0x00]
const manifest = (page) => page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent))

/** Share of the stage in a color, and how far from the middle of the stage its nearest pixel is. */
async function seen(page, color, tolerance = 10) {
  const box = await stageBox(page)
  const picture = await screen(page)
  let [count, nearest] = [0, Infinity]
  for (let y = Math.ceil(box.y); y < box.y + box.height - 1; y++)
    for (let x = Math.ceil(box.x); x < box.x + box.width - 1; x++)
      if (near(picture.at(x, y), color, tolerance)) {
        count++
        nearest = Math.min(nearest, Math.hypot(x - box.cx, y - box.cy))
      }
  return { share: count / (box.width * box.height), nearest }
}

export const defects = [
  [
    'the list has every kind with its count, and says what was not found',
    async (session) => {
      const page = await session.report('defects', { scripts: false })
      const { result } = JSON.parse(await page.locator('#manifest').textContent())
      const rows = await page.locator('.kind summary').allInnerTexts()
      const found = Object.entries(result.defects).filter(([, d]) => d.count > 0)
      assert.equal(rows.length, found.length)
      const counts = rows.map((r) => Number(/(\d+)\s*$/.exec(r)[1]))
      assert.deepEqual(counts.toSorted(), found.map(([, d]) => d.count).toSorted())
      assert.match(await page.locator('h1').innerText(), /Not sound/)
      assert.match(await page.locator('.absent').first().innerText(), /Facets without area/)
      for (const kind of ['holes', 'duplicate_facets', 'non_manifold_edges', 'islands']) assert.ok(result.defects[kind].count > 0, kind)
    },
  ],
  [
    'J walks through all kinds: each is chosen, flown to, seen in its place, and told',
    async (session) => {
      const page = await session.report('defects', { reducedMotion: 'reduce' })
      const { picks } = await manifest(page)
      const kinds = await page.evaluate(() => [...document.querySelectorAll('.kind')].map((k) => ({ name: k.querySelector('.kind-name').textContent, first: Number(k.querySelector('tr[data-pick]').dataset.pick) })))
      assert.ok(kinds.length >= 5)
      for (const { name, first } of kinds) {
        // The one before it, then on with J: also from kind to kind.
        await page.evaluate((n) => document.querySelector(`tr[data-pick="${n}"]`).click(), (first + picks.length - 1) % picks.length)
        await page.locator('canvas').focus()
        await page.keyboard.press('j')
        await settled(page)
        assert.equal(await page.locator('tr[aria-selected=true]').getAttribute('data-pick'), String(first))
        assert.ok(await page.locator('tr[aria-selected=true]').isVisible(), name)
        assert.ok((await page.locator('.unseen').textContent()).startsWith(name))
        const { share, nearest } = await seen(page, CHOSEN)
        assert.ok(share > 1e-5 && share < 0.6, `${name}: ${share} of the stage`)
        const half = 0.5 * (await stageBox(page)).height
        assert.ok(nearest < half, `${name}: ${nearest} pixels from the middle`)
      }
      await page.keyboard.press('Escape')
      assert.equal(await page.locator('tr[aria-selected=true]').count(), 0)
    },
  ],
  [
    'a hole is drawn in the colour of its row, and D takes it away',
    async (session) => {
      const page = await session.report('defects', { reducedMotion: 'reduce' })
      await page.keyboard.press('1')
      await settled(page)
      const swatch = await page.evaluate(() => {
        const kind = [...document.querySelectorAll('.kind')].find((k) => k.querySelector('.kind-name').textContent === 'Holes')
        return kind.querySelector('rect').getAttribute('fill')
      })
      const color = [1, 3, 5].map((k) => parseInt(swatch.slice(k, k + 2), 16))
      assert.ok((await seen(page, color)).share > 2e-4, 'marked')
      await page.keyboard.press('d')
      await settled(page)
      assert.equal((await seen(page, color)).share, 0, 'taken away')
    },
  ],
  [
    'the inner side is hatched, and B makes it plain',
    async (session) => {
      const page = await session.report('defects', { reducedMotion: 'reduce' })
      const hole = await page.evaluate(() => {
        const { picks, result } = JSON.parse(document.getElementById('manifest').textContent)
        const { position } = result.defects.holes.items[0]
        return picks.findIndex((p) => String(p.position) === String(position))
      })
      await page.evaluate((n) => document.querySelector(`tr[data-pick="${n}"]`).click(), hole)
      await settled(page)
      const colors = async () => {
        const box = await stageBox(page)
        const picture = await screen(page)
        return new Set(Array.from({ length: 144 }, (_, i) => hex(picture.at(box.cx + (i % 12), box.cy + Math.floor(i / 12)))))
      }
      const violet = (c) => parseInt(c.slice(1, 3), 16) > 1.15 * parseInt(c.slice(3, 5), 16)
      const inner = await colors()
      assert.ok(inner.size >= 2 && [...inner].every(violet), [...inner].join(' '))
      await page.keyboard.press('b')
      await settled(page)
      assert.ok(![...(await colors())].some(violet))
    },
  ],
  [
    'keyboard alone: from a kind to its rows, along them, to the place',
    async (session) => {
      const page = await session.report('defects', { reducedMotion: 'reduce' })
      const kind = page.locator('.kind:has(tr[data-pick]:nth-of-type(3))').first()
      const third = await kind.locator('tr[data-pick]').nth(2).getAttribute('data-pick')
      await kind.locator('summary').focus()
      await page.keyboard.press('Enter')
      await page.keyboard.press('Tab')
      await page.keyboard.press('ArrowDown')
      await page.keyboard.press('ArrowDown')
      await page.keyboard.press('Enter')
      await settled(page)
      assert.equal(await page.locator('tr[aria-selected=true]').getAttribute('data-pick'), third)
      const at = await page.evaluate(() => document.activeElement.dataset.pick)
      assert.equal(at, third)
    },
  ],
  [
    'a sound mesh: the verdict, the model, no scale, no list',
    async (session) => {
      const page = await session.report('sound')
      assert.match(await page.locator('h1').innerText(), /Sound/)
      assert.equal(await page.locator('.kind').count(), 0)
      assert.equal(await page.locator('#scale, #figure').count(), 0)
      assert.deepEqual(page.seen.errors, [])
      assert.deepEqual(await page.evaluate(() => window.violations), [])
    },
  ],
]
