// Sections drawn in the plane: what is drawn lies where the exact lines and arcs do, in the colors of their kinds.
import assert from 'node:assert/strict'
import { near as alike, screen } from '../browser.mjs'

const [SEGMENTS, JOINS] = [4, 3]

/** From a place of the section to a pixel of the page, by the drawing's frame alone. */
async function mapping(page) {
  const { origin, seen, box } = await page.evaluate(() => {
    const plan = [...document.querySelectorAll('svg.plan')].find((p) => p.getClientRects().length)
    const b = plan.getBoundingClientRect()
    return {
      origin: plan.dataset.origin.split(' ').map(Number),
      seen: plan.getAttribute('viewBox').split(' ').map(Number),
      box: [b.x, b.y, b.width, b.height],
    }
  })
  const pixel = Math.max(seen[2] / box[2], seen[3] / box[3])
  const at = ([x, y]) => [
    box[0] + box[2] / 2 + (x - origin[0] - seen[0] - seen[2] / 2) / pixel,
    box[1] + box[3] / 2 + (origin[1] - y - seen[1] - seen[3] / 2) / pixel,
  ]
  return { at, pixel, box }
}

const token = (page, name) =>
  page.evaluate((name) => {
    const c = getComputedStyle(document.documentElement).getPropertyValue(name).trim()
    return [1, 3, 5].map((k) => parseInt(c.slice(k, k + 2), 16))
  }, name)

/** Whether a color is on the screen within a pixel of a place. */
const has = (picture, [x, y], color) => [-1, 0, 1].some((dx) => [-1, 0, 1].some((dy) => alike(picture.at(x + dx, y + dy), color, 40)))

const manifest = (page) => page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent))

/** Places of the profile of the fixtures, away from its joins. */
const line = [3, 8, 13, 18].map((s) => [1000 + s, -500])
const arc = [0.3, 0.6, 0.9, 1.2].map((a) => [1020 + 8 * Math.sin(a), -492 - 8 * Math.cos(a)])
const rest = [[1028, -490], [1028, -483], [1022, -480], [1016, -480]]

/** Points and comb hide the colors of the segments: they are taken away. */
async function bare(page) {
  await page.keyboard.press('c')
  await page.keyboard.press('d')
  await page.keyboard.press('v')
}

async function drawnRight(page, places = [line, arc, rest]) {
  const { at } = await mapping(page)
  const [ofLine, ofArc, ground] = [await token(page, '--k-line'), await token(page, '--k-arc'), await token(page, '--paper')]
  const picture = await screen(page)
  for (const p of [...places[0], ...places[2]]) assert.ok(has(picture, at(p), ofLine), `line at ${p}: ${picture.at(...at(p))}`)
  for (const p of places[1]) {
    assert.ok(has(picture, at(p), ofArc), `arc at ${p}: ${picture.at(...at(p))}`)
    // 8 pixels inside of the arc there is nothing.
    const { pixel } = await mapping(page)
    const inner = [1020 + (p[0] - 1020) * (1 - pixel), -492 + (p[1] + 492) * (1 - pixel)]
    assert.ok(alike(picture.at(...at(inner)), ground, 12), `inside at ${inner}`)
  }
}

export const drawing = [
  [
    'a section lies where its exact lines and arcs do, in their colours, light and dark, wide and narrow',
    async (session) => {
      for (const colorScheme of ['light', 'dark'])
        for (const [width, height] of [[1280, 800], [390, 844]]) {
          const page = await session.report('section', { width, height, colorScheme, live: false })
          await page.waitForSelector('.stage.live')
          await bare(page)
          await drawnRight(page)
          assert.deepEqual(page.seen.errors, [])
          assert.deepEqual(await page.evaluate(() => window.violations), [])
        }
    },
  ],
  [
    'it is drawn with scripts off too, with its tables',
    async (session) => {
      const page = await session.report('section', { scripts: false })
      assert.equal(await page.locator('.segment').count(), SEGMENTS)
      const text = await page.locator('.list').innerText()
      assert.match(text, /tangent/)
      assert.match(text, /corner/)
      assert.match(text, /r\s7\.99|r\s8\.00/)
      assert.match(await page.locator('h1').innerText(), /Segments found/)
    },
  ],
  [
    'wheel and drag keep the place under the cursor, signs keep their size, F shows all',
    async (session) => {
      const page = await session.report('section', { live: false })
      await page.waitForSelector('.stage.live')
      const before = await mapping(page)
      const near = before.at([1012, -500])
      // Events tell whole pixels.
      const [x, y] = near.map(Math.round)
      const place = [1012 + (x - near[0]) * before.pixel, -500 - (y - near[1]) * before.pixel]
      const size = () => page.evaluate(() => document.querySelector('.join circle').getBoundingClientRect().width)
      const first = await size()
      await page.mouse.move(x, y)
      for (let i = 0; i < 5; i++) await page.mouse.wheel(0, -300)
      await page.waitForFunction((p) => Number(document.querySelector('svg.plan').getAttribute('viewBox').split(' ')[2]) < p, before.pixel * before.box[2] * 0.5)
      const after = await mapping(page)
      const now = after.at(place)
      assert.ok(Math.hypot(now[0] - x, now[1] - y) < 0.5, `${now} ${x} ${y}`)
      assert.ok(Math.abs((await size()) - first) < 0.2)
      const [u, v] = (await page.locator('#readout').innerText()).match(/−?[\d,]+\.\d+/g).map((s) => Number(s.replace('−', '-').replace(',', '')))
      assert.ok(Math.hypot(u - place[0], v - place[1]) < 2 * before.pixel, `${u} ${v} ${place}`)
      await page.mouse.down()
      await page.mouse.move(x + 40, y - 30, { steps: 4 })
      await page.mouse.up()
      const dragged = (await mapping(page)).at(place)
      assert.ok(Math.hypot(dragged[0] - x - 40, dragged[1] - y + 30) < 0.5, `${dragged}`)
      await page.keyboard.press('f')
      assert.ok(Math.abs((await mapping(page)).pixel - before.pixel) < 1e-9)
    },
  ],
  [
    'a row leads to its segment or join, a click on a segment to its row',
    async (session) => {
      const page = await session.report('section', { live: false })
      await page.waitForSelector('.stage.live')
      const { picks, result } = await manifest(page)
      assert.equal(picks.length, SEGMENTS + JOINS)
      const join = result.contours[0].joins[1]
      await page.locator(`tr[data-pick="${SEGMENTS + 1}"]`).click()
      const { at, box } = await mapping(page)
      const [x, y] = at(join.point)
      assert.ok(Math.hypot(x - box[0] - box[2] / 2, y - box[1] - box[3] / 2) < 1, 'the join is in the middle')
      await page.keyboard.press('f')
      const back = await mapping(page)
      await page.mouse.click(...back.at(arc[1]))
      assert.equal(await page.locator('tr[data-pick="1"]').getAttribute('aria-selected'), 'true')
      assert.equal(await page.locator('.segment.chosen').getAttribute('data-mark'), '1')
    },
  ],
  [
    'the ruler is as long as it says',
    async (session) => {
      const page = await session.report('section', { live: false })
      await page.waitForSelector('.stage.live')
      const { pixel } = await mapping(page)
      const [length, width, text] = await page.evaluate(() => {
        const bar = document.querySelector('.ruler')
        return [Number(bar.dataset.length), bar.getBoundingClientRect().width, bar.innerText]
      })
      assert.ok(Math.abs(width * pixel - length) < 0.02 * length, `${width * pixel} ${length}`)
      assert.equal(text, `${length} mm`)
    },
  ],
  [
    'of several planes one is drawn at a time, and rows of the others change it',
    async (session) => {
      const page = await session.report('stack', { live: false })
      await page.waitForSelector('.stage.live')
      const seen = () => page.evaluate(() => [...document.querySelectorAll('.sheet')].map((s) => !s.hidden))
      assert.deepEqual(await seen(), [true, false])
      assert.equal(await page.locator('.sheet').first().locator('.segment').count(), 2)
      await page.locator('tr[data-pick="2"]').click()
      assert.deepEqual(await seen(), [false, true])
      const courses = await page.evaluate(() => [...document.querySelectorAll('.course')].map((s) => !s.hidden))
      assert.deepEqual(courses, [false, false, true])
      await page.locator('.stage-tools select').selectOption('0')
      assert.deepEqual(await seen(), [true, false])
    },
  ],
  [
    'every column of a table is in sight, at any width and in every language',
    async (session) => {
      for (const width of [1440, 1280, 820, 390]) {
        const page = await session.report('section', { width, height: 900, live: false })
        await page.waitForSelector('.stage.live')
        await page.evaluate(() => document.querySelectorAll('details').forEach((d) => (d.open = true)))
        for (const language of ['en', 'de', 'ru', 'zh-Hans']) {
          await page.locator('#tools select').selectOption(language)
          const cut = await page.evaluate(() => {
            const end = document.querySelector('.list').getBoundingClientRect().right
            const cells = [...document.querySelectorAll('.list th, .list td')].filter((c) => c.getBoundingClientRect().right > end + 0.5)
            const holders = [...document.querySelectorAll('.list, .wide')].filter((e) => e.scrollWidth > e.clientWidth)
            return [...cells.map((c) => c.innerText), ...holders.map((e) => `${e.className} ${e.scrollWidth} in ${e.clientWidth}`)]
          })
          assert.deepEqual(cut, [], `${width} ${language}`)
        }
        await session.tidy()
      }
    },
  ],
  [
    'no button and no ruler lies over a join, on the screen and the phone',
    async (session) => {
      for (const [width, height] of [[1440, 900], [1000, 900], [390, 844]]) {
        const page = await session.report('section', { width, height, live: false })
        await page.waitForSelector('.stage.live')
        const found = await page.evaluate(() => {
          const boxes = (css) => [...document.querySelectorAll(css)].filter((e) => e.getClientRects().length).map((e) => e.getBoundingClientRect())
          const joins = boxes('svg.plan .join circle, svg.plan .join path')
          const over = boxes('.stage-tools button, .stage-tools select, .ruler')
          const sheet = document.querySelector('svg.plan').getBoundingClientRect()
          const meets = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom
          const inside = (a) => a.left > sheet.left && a.right < sheet.right && a.top > sheet.top && a.bottom < sheet.bottom
          // The strip of the tools is above all of the drawing.
          const strip = Math.max(...boxes('.stage-tools').map((b) => b.bottom))
          return { joins: joins.length, covered: joins.filter((j) => over.some((o) => meets(j, o))).length, out: joins.filter((j) => !inside(j)).length, strip, top: sheet.top }
        })
        assert.ok(found.joins >= JOINS)
        assert.deepEqual([found.covered, found.out], [0, 0], `${width}`)
        assert.ok(found.strip <= found.top + 0.5, `${width}: the tools reach to ${found.strip}, the drawing begins at ${found.top}`)
      }
    },
  ],
  [
    'paper: drawing, residuals and tables on few pages, nothing of the tools',
    async (session) => {
      const page = await session.report('section', { width: 800, height: 1100, live: false, colorScheme: 'dark' })
      await page.waitForSelector('.stage.live')
      const pages = (await page.pdf({ format: 'A4', printBackground: true })).toString('latin1').match(/\/Type\s*\/Page\b/g).length
      assert.ok(pages <= 2, `${pages} pages`)
      await page.emulateMedia({ media: 'print' })
      assert.ok(await page.locator('.plan').isVisible() && await page.locator('.course').isVisible())
      assert.ok(!(await page.locator('.stage-tools').isVisible()))
      assert.deepEqual(await token(page, '--paper'), [255, 255, 255])
    },
  ],
  [
    'a nominal is drawn with its deviations; rows lead to the points farthest off, and to what was not measured',
    async (session) => {
      const page = await session.report('against', { live: false })
      await page.waitForSelector('.stage.live')
      assert.deepEqual(page.seen.errors, [])
      const seen = (css) => page.evaluate((css) => [...document.querySelectorAll(css)].filter((e) => getComputedStyle(e).display !== 'none' && e.getClientRects().length).length, css)
      assert.deepEqual(await Promise.all(['.plan .nominal', '.plan .missed', '.plan .whisker', '.plan .worst', '.plan .comb'].map(seen)), [2, 1, 2, 2, 0])
      // Signs and their numbers belong to the drawing: words of a page would end it.
      const worst = (await manifest(page)).result.nominal.worst
      const labels = await page.evaluate(() => [...document.querySelectorAll('svg.plan .worst text')].map((t) => t.textContent))
      assert.deepEqual(labels.map((t) => t[0]), ['+', '−'])
      labels.forEach((t, k) => assert.ok(Math.abs(Math.abs(worst[k].deviation) - Number(t.slice(1))) < 1e-3, `${t}`))
      await page.keyboard.press('n')
      await page.keyboard.press('w')
      assert.deepEqual(await Promise.all(['.plan .nominal', '.plan .whisker', '.plan .worst'].map(seen)), [0, 0, 0])
      await page.keyboard.press('n')
      await page.keyboard.press('w')
      const rows = page.locator('.farthest tr[data-pick]')
      await rows.nth(1).click()
      const middle = () => page.evaluate(() => {
        const c = document.querySelector('.plan .chosen').getBoundingClientRect()
        const b = document.querySelector('svg.plan').getBoundingClientRect()
        return Math.hypot(c.x + c.width / 2 - b.x - b.width / 2, c.y + c.height / 2 - b.y - b.height / 2)
      })
      assert.equal(await page.locator('.plan .chosen').getAttribute('class'), 'worst minus chosen')
      assert.ok((await middle()) < 60, `${await middle()}`)
      assert.equal(await seen('.course'), 1)
      await page.locator('.outlines tr[data-pick]').last().click()
      assert.equal(await page.locator('.plan .chosen').getAttribute('class'), 'nominal missed chosen')
      assert.ok((await middle()) < 2, `${await middle()}`)
    },
  ],
  [
    'a plane whose axis points down is turned, and its coordinates are told all the same',
    async (session) => {
      const page = await session.report('against', { live: false })
      await page.waitForSelector('.stage.live')
      const { result } = await manifest(page)
      const [one, last] = [result.contours[0].joins[0], result.contours[0].joins.at(-1)].map((j) => j.point)
      const signs = await page.evaluate(() => [...document.querySelectorAll('.plan .join')].map((j) => {
        const b = j.querySelector('path, circle').getBoundingClientRect()
        return [b.x + b.width / 2, b.y + b.height / 2]
      }))
      // The later join has the greater second coordinate, which is the lower one in space.
      assert.ok(last[1] > one[1] && signs.at(-1)[1] > signs[0][1])
      await page.mouse.move(...signs[0])
      const [u, v] = (await page.locator('#readout').innerText()).match(/−?[\d,]+\.\d+/g).map((s) => Number(s.replace('−', '-').replace(',', '')))
      const { pixel } = await mapping(page)
      assert.ok(Math.hypot(u - one[0], v - one[1]) < 2 * pixel, `${u} ${v} ${one}`)
    },
  ],
]
