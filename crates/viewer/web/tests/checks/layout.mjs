// What a reader sees around the part: nothing broken, nothing covered, on the screen, the phone and paper.
import assert from 'node:assert/strict'
import { settled, stageBox } from '../browser.mjs'
import { view } from './colors.mjs'

/** Words of an element that stand on more than one line, but for places where they may be parted. */
const broken = (page, css) =>
  page.evaluate((css) => {
    const found = []
    for (const cell of document.querySelectorAll(css)) {
      const walker = document.createTreeWalker(cell, NodeFilter.SHOW_TEXT)
      for (let node = walker.nextNode(); node; node = walker.nextNode())
        for (const match of node.data.matchAll(/[^\s\u00ad]+/g)) {
          const tops = [...match[0]].map((_, i) => {
            const range = document.createRange()
            range.setStart(node, match.index + i)
            range.setEnd(node, match.index + i + 1)
            // After a hyphen that the line was parted at, the letter is the last of two.
            return Math.round([...range.getClientRects()].at(-1)?.top ?? 0)
          })
          if (new Set(tops).size > 1) found.push(match[0])
        }
    }
    return found
  }, css)

const overlap = (a, b) => a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height
const boxes = (page, css) => page.evaluate((css) => [...document.querySelectorAll(css)].map((e) => e.getBoundingClientRect().toJSON()), css)

export const layout = [
  [
    'no word of a table is broken inside, in four languages',
    async (session) => {
      for (const name of ['sphere', 'zone', 'plan', 'plan_kinds']) {
        const page = await session.report(name, { width: 1440, height: 900 })
        for (const language of ['en', 'de', 'ru', 'zh-Hans']) {
          await page.locator('#tools select').selectOption(language)
          if (language !== 'zh-Hans') assert.deepEqual(await broken(page, '.list th, .list td'), [], `${name} ${language}`)
          assert.ok(await page.evaluate(() => document.querySelector('.list').scrollWidth <= document.querySelector('.list').clientWidth), `${name} ${language} is too wide`)
        }
      }
    },
  ],
  [
    'no sentence stays in the language before, nor with its point',
    async (session) => {
      const page = await session.report('sphere')
      await page.locator('#tools select').selectOption('de')
      const words = await page.locator('.words').first().innerText()
      assert.match(words, /^In Toleranz 33,67\s%/)
      assert.match(words, /darüber .*darunter/)
      assert.match(await page.title(), /^Nicht in Ordnung · /)
      assert.match(await page.locator('#picture').getAttribute('alt'), /^Farbkarte/)
      const small = await session.report('elements')
      await small.locator('#tools select').selectOption('de')
      assert.match(await small.locator('#numbers').innerText(), /\d,\de−\d/)
    },
  ],
  [
    'the shares stand beside the bars, and a drag over them selects no text',
    async (session) => {
      const page = await session.report('sphere', { width: 1440, height: 900 })
      const [shares, bars] = [await boxes(page, '.chart text.share'), await boxes(page, '.chart .bar')]
      assert.ok(shares.length >= 9 && bars.length > 50)
      for (const share of shares) assert.ok(!bars.some((bar) => bar.width > 0.5 && overlap(share, bar)), JSON.stringify(share))
      // The longest share, where all are within tolerance; and the columns' heads stay on one line.
      const all = await session.report('few_fit', { width: 1440, height: 900 })
      const room = await all.evaluate(() => {
        const bars = Math.max(...[...document.querySelectorAll('.chart .bar')].map((b) => b.getBoundingClientRect().right))
        const share = document.querySelector('.chart text.share')
        share.textContent = '≈100.0\u00a0%'
        return share.getBoundingClientRect().left - bars
      })
      assert.ok(room >= 0, `${room}`)
      const heads = await page.evaluate(() => [...document.querySelectorAll('.statistics thead span')].map((s) => s.getClientRects().length))
      assert.deepEqual(heads, [1, 1, 1])
      const chart = await page.locator('.chart svg').boundingBox()
      await page.mouse.move(chart.x + chart.width / 2, chart.y + chart.height * 0.4)
      await page.mouse.down()
      await page.mouse.move(chart.x + chart.width / 2, chart.y + chart.height * 0.6, { steps: 3 })
      await page.mouse.move(chart.x - 700, chart.y + chart.height * 0.7, { steps: 3 })
      await page.mouse.up()
      assert.equal(await page.evaluate(() => String(getSelection())), '')
      assert.ok(await page.locator('.only strong').isVisible(), 'a range is chosen')
    },
  ],
  [
    'phone: the title is there, and no flag lies on the part',
    async (session) => {
      const page = await session.report('behind', { width: 390, height: 844 })
      assert.ok(await page.locator('.title').isVisible())
      assert.match(await page.locator('.title').innerText(), /^Inspection of part\.stl/)
      const sphere = await session.report('sphere', { width: 390, height: 844 })
      const box = await stageBox(sphere)
      const radius = (10 * box.height) / (await view(sphere))
      const target = await sphere.evaluate(() => JSON.parse(decodeURIComponent(location.hash.slice(3))).eye)
      assert.ok(2 * radius > 0.6 * box.width, `${(2 * radius) / box.width} of the stage`)
      // The sphere's middle is the stage's but for the room that the tools take.
      const shift = Math.hypot(target[4], target[5], target[6]) * (box.height / target[7])
      const middle = { x: box.cx, y: box.cy + shift }
      const flags = await boxes(sphere, '.flag')
      assert.equal(flags.length, 6)
      const tools = await sphere.locator('.stage-tools').boundingBox()
      for (const button of await boxes(sphere, '.stage-tools button, .stage-tools select')) assert.ok(button.height >= 44 && button.width >= 44, JSON.stringify(button))
      for (const flag of flags) {
        const dx = Math.max(flag.x - middle.x, 0, middle.x - flag.x - flag.width)
        const dy = Math.max(flag.y - middle.y, 0, middle.y - flag.y - flag.height)
        assert.ok(Math.hypot(dx, dy) >= radius, JSON.stringify(flag))
        assert.ok(!overlap(flag, tools), 'under the tools')
      }
    },
  ],
  [
    'four references: the header names the one that is shown, and how many there are',
    async (session) => {
      for (const scripts of [true, false]) {
        const page = await session.report('four', { scripts, live: false })
        const who = await page.locator('.who').innerText()
        assert.equal(who.match(/Reference/g).length, 1, who)
        assert.match(who, /1 \/ 4/)
      }
      const page = await session.report('four')
      await page.locator('tr[data-choose="2"]').click()
      await settled(page)
      assert.match(await page.locator('.who').innerText(), /3 \/ 4/)
    },
  ],
  [
    'a window of middle width: the scale is as high as the picture and stays so',
    async (session) => {
      const page = await session.report('sphere', { width: 1000, height: 700 })
      const heights = () =>
        page.evaluate(() => ['.stage', '.scale'].map((s) => document.querySelector(s).getBoundingClientRect().height))
      const before = await heights()
      await page.waitForTimeout(500)
      assert.deepEqual(await heights(), before)
      assert.ok(Math.abs(before[0] - before[1]) < 1 && before[0] < 700, before.join())
    },
  ],
  [
    'paper: long lists are cut and say so, the picture has the numbers, a running head names the part',
    async (session) => {
      const page = await session.report('torn', { width: 800, height: 1100 })
      const pdf = await page.pdf({ format: 'A4', printBackground: true })
      const pages = pdf.toString('latin1').match(/\/Type\s*\/Page\b/g).length
      assert.ok(pages <= 4, `${pages} pages`)
      await page.emulateMedia({ media: 'print' })
      const kinds = await page.evaluate(() => {
        document.querySelectorAll('details').forEach((d) => (d.open = true))
        return [...document.querySelectorAll('.kind')].map((k) => {
          const rows = [...k.querySelectorAll('tr[data-pick]')]
          return { rows: rows.length, printed: rows.filter((r) => r.getClientRects().length > 0).length, note: k.querySelector('.paper')?.innerText ?? '' }
        })
      })
      const long = kinds.filter((k) => k.rows > 12)
      assert.ok(long.length > 0)
      for (const { rows, printed, note } of long) {
        assert.equal(printed, 12)
        assert.equal(note.replace(/\s/g, ' '), `+ ${rows - 12} more, not printed`)
      }
      const heads = await page.evaluate(() => [...document.styleSheets].flatMap((s) => [...s.cssRules]).map((r) => r.cssText).filter((t) => t.includes('@top-left')))
      assert.ok(heads.some((t) => t.includes('part.stl') && t.includes('4711')), heads.join())
      assert.deepEqual(await page.evaluate(() => window.violations), [])
      const compared = await session.report('behind', { width: 390, height: 844 })
      await compared.evaluate(() => window.dispatchEvent(new Event('beforeprint')))
      await compared.emulateMedia({ media: 'print' })
      assert.ok(await compared.locator('.title').isVisible())
      const texts = await compared.locator('.flagged text').allTextContents()
      assert.ok(texts.length >= 5 && texts.every((t, n) => t.includes('.') && texts.some((u) => new RegExp(`^${n + 1}\\s`).test(u))), texts.join(' | '))
      assert.ok(await compared.locator('.flagged').isVisible())
      const [picture, flags] = [await compared.evaluate(() => [document.getElementById('picture').naturalWidth, document.getElementById('picture').naturalHeight]), await compared.locator('.flagged').getAttribute('viewBox')]
      assert.equal(flags, `0 0 ${picture[0] / 2} ${picture[1] / 2}`)
      assert.ok(picture[0] >= 2190, 'at least 300 dots to the inch')
    },
  ],
]
