// Trends: every dot lies where its value does, numbers are those of the document, rows, dots and charts lead to one another.
import assert from 'node:assert/strict'
import { near as alike, screen } from '../browser.mjs'

const manifest = (page) => page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent))

/** Color of a token of the style sheet. */
const token = (page, name) =>
  page.evaluate((name) => {
    const c = getComputedStyle(document.documentElement).getPropertyValue(name).trim()
    return [1, 3, 5].map((k) => parseInt(c.slice(k, k + 2), 16))
  }, name)

/** What is drawn in each chart, in units of the chart, and what the chart says of its axes. */
const drawn = (page) =>
  page.evaluate(() =>
    Object.fromEntries(
      [...document.querySelectorAll('.chart')].map((figure) => {
        const plot = figure.querySelector('.plot')
        const { width, height } = plot.viewBox.baseVal
        const places = (css) => [...figure.querySelectorAll(css)].flatMap((p) => [...p.getAttribute('d').matchAll(/M([\d.-]+) ([\d.-]+)h0/g)].map((m) => [Number(m[1]) / width, 1 - Number(m[2]) / height]))
        const level = (css) => [...figure.querySelectorAll(`.plot path.${css}`)].map((p) => 1 - Number(p.getAttribute('d').match(/^M0 ([\d.-]+)H/)?.[1]) / height)
        const line = figure.querySelector('.course-line')?.getAttribute('d') ?? ''
        return [
          figure.dataset.of,
          {
            from: Number(plot.dataset.from),
            to: Number(plot.dataset.to),
            dots: Object.fromEntries(['pass', 'fail', 'undecided', 'not_measured'].map((v) => [v, places(`.plot .dots.${v}`)])),
            rings: places('.plot .ring'),
            missing: [...(figure.querySelector('.missing')?.getAttribute('d') ?? '').matchAll(/M([\d.-]+) /g)].map((m) => Number(m[1]) / width),
            line: [...line.matchAll(/[ML]([\d.-]+) ([\d.-]+)/g)].map((m) => [Number(m[1]) / width, 1 - Number(m[2]) / height]),
            breaks: (line.match(/M/g) ?? []).length,
            whiskers: [...(figure.querySelector('.whiskers')?.getAttribute('d') ?? '').matchAll(/M([\d.-]+) ([\d.-]+)V([\d.-]+)/g)].map((m) => [Number(m[1]) / width, 1 - Number(m[2]) / height, 1 - Number(m[3]) / height]),
            mean: level('mean'),
            control: level('control'),
            limit: level('limit'),
            nominal: level('nominal'),
            ticks: [...figure.querySelectorAll('.values path')].map((p, i) => [1 - Number(p.getAttribute('d').match(/ ([\d.-]+)H/)[1]) / height, Number(figure.querySelectorAll('.values text')[i].dataset.n)]),
            gutter: [...figure.querySelectorAll('.gutter tspan[data-n]')].map((t) => [t.parentElement.getAttribute('class'), Number(t.dataset.n), t.parentElement.textContent]),
          },
        ]
      }),
    ),
  )

/** As near as three digits after the point of a chart's 220 units are. */
const close = (found, wanted, what) => assert.ok(Math.abs(found - wanted) < 2e-5, `${what}: ${found}, wanted ${wanted}`)

/** All places of a page against the values of its document. */
function compare(charts, result) {
  const parts = result.parts.length
  result.characteristics.forEach((c, n) => {
    const chart = charts[n]
    const at = (value) => (value - chart.from) / (chart.to - chart.from)
    const x = (part) => (part + 0.5) / parts
    for (const verdict of ['pass', 'fail', 'undecided', 'not_measured']) {
      const wanted = c.verdicts.flatMap((v, part) => (v === verdict ? [part] : []))
      assert.equal(chart.dots[verdict].length, wanted.length, `${c.id} ${verdict}`)
      wanted.forEach((part, i) => {
        const [u, v] = chart.dots[verdict][i]
        close(u, x(part), `${c.id} part ${part}`)
        // Without a value it stands at the foot, and a bar through the chart says so.
        if (c.values[part] === null) assert.ok(v > 0 && v < 0.05, `${v}`)
        else close(v, at(c.values[part]), `${c.id} value ${part}`)
      })
    }
    const there = c.values.flatMap((v, part) => (v === null ? [] : [part]))
    assert.equal(chart.line.length, there.length)
    there.forEach((part, i) => (close(chart.line[i][0], x(part), 'line'), close(chart.line[i][1], at(c.values[part]), 'line')))
    assert.equal(chart.breaks, there.filter((part, i) => i === 0 || there[i - 1] !== part - 1).length, 'the line is broken where a value is missing')
    const none = c.values.flatMap((v, part) => (v === null ? [part] : []))
    assert.equal(chart.missing.length, none.length)
    none.forEach((part, i) => close(chart.missing[i], x(part), 'missing'))
    const rings = [...new Set(c.out_of_control.map((o) => o.part))]
    assert.equal(chart.rings.length, rings.length)
    rings.forEach((part, i) => (close(chart.rings[i][0], x(part), 'ring'), close(chart.rings[i][1], at(c.values[part]), 'ring')))
    const bars = (c.uncertainties ?? []).flatMap((u, part) => (u === null || c.values[part] === null ? [] : [part]))
    assert.equal(chart.whiskers.length, bars.length)
    bars.forEach((part, i) => {
      close(chart.whiskers[i][1], at(c.values[part] - c.uncertainties[part]), 'bar')
      close(chart.whiskers[i][2], at(c.values[part] + c.uncertainties[part]), 'bar')
    })
    const inside = (values) => values.filter((v) => v !== null && v >= chart.from && v <= chart.to)
    const levels = [
      ['mean', c.control ? [c.mean] : []],
      ['control', c.control && c.control.upper > c.control.lower ? [c.control.upper, c.control.lower] : []],
      ['nominal', inside([c.nominal])],
    ]
    if (!c.own_upper) levels.push(['limit', inside([c.upper, c.lower])])
    for (const [name, values] of levels) {
      assert.equal(chart[name].length, values.length, `${c.id} ${name}`)
      values.forEach((v, i) => close(chart[name][i], at(v), `${c.id} ${name}`))
    }
    // A limit that is not in the chart is named beside it, with an arrow.
    for (const limit of [c.upper, c.lower].filter((l) => l !== null)) {
      const label = chart.gutter.find(([name, value]) => name === 'limit' && value === limit)
      assert.ok(label, `${c.id} names ${limit}`)
      assert.equal(/^[↑↓]/.test(label[2]), limit > chart.to || limit < chart.from, label[2])
    }
    for (const [v, value] of chart.ticks) assert.ok(Math.abs(v - at(value)) < 1e-4, `${c.id} tick ${value} at ${v}`)
  })
}

export const trend = [
  [
    'every dot, bar, ring and line of a trend lies where its exact value does: many, one, missing, alike, one limit',
    async (session) => {
      for (const name of ['trend', 'trend_one', 'trend_long']) {
        const page = await session.report(name, { live: false })
        await page.waitForSelector('.stage.live')
        const { result } = await manifest(page)
        compare(await drawn(page), result)
        assert.deepEqual(page.seen.errors, [])
        assert.deepEqual(await page.evaluate(() => window.violations), [])
      }
    },
  ],
  [
    'dots have the colours of their verdicts on the screen, light and dark, wide and narrow',
    async (session) => {
      for (const colorScheme of ['light', 'dark'])
        for (const [width, height] of [[1440, 900], [390, 844]]) {
          const page = await session.report('trend', { width, height, colorScheme, live: false })
          await page.waitForSelector('.stage.live')
          const { result } = await manifest(page)
          const colors = { pass: await token(page, '--pass'), fail: await token(page, '--fail'), undecided: await token(page, '--undecided'), not_measured: await token(page, '--unknown') }
          const c = result.characteristics[0]
          await page.locator('#course-0 .plot').scrollIntoViewIfNeeded()
          await page.mouse.move(2, 2)
          const picture = await screen(page)
          const { box, from, to } = await page.evaluate(() => {
            const plot = document.querySelector('#course-0 .plot')
            const b = plot.getBoundingClientRect()
            const edge = Number.parseFloat(getComputedStyle(plot).borderLeftWidth)
            return { box: [b.x + edge, b.y, b.width - edge, b.height - edge], from: Number(plot.dataset.from), to: Number(plot.dataset.to) }
          })
          c.values.forEach((value, part) => {
            const x = box[0] + (box[2] * (part + 0.5)) / c.values.length
            const y = value === null ? box[1] + box[3] * (1 - 7 / 220) : box[1] + (box[3] * (to - value)) / (to - from)
            // An undecided dot is a ring, and bars go up and down through dots: beside the middle.
            const places = [[0, 0], [-3, 0], [3, 0], [-2, 0], [2, 0], [-4, 0], [4, 0]]
            const color = colors[c.verdicts[part]]
            assert.ok(places.some(([dx, dy]) => alike(picture.at(x + dx, y + dy), color, 40)), `${colorScheme} ${width} part ${part}: ${c.verdicts[part]} ${picture.at(x, y)} instead of ${color}`)
          })
          await session.tidy()
        }
    },
  ],
  [
    'the numbers under the charts are those of the document, and stand with scripts off too',
    async (session) => {
      const page = await session.report('trend', { live: false })
      const { result } = await manifest(page)
      const indices = await page.evaluate(() => [...document.querySelectorAll('.chart')].map((f) => [Number(f.dataset.of), Object.fromEntries([...f.querySelectorAll('[data-index]')].map((d) => [d.dataset.index, [...d.querySelectorAll('[data-n]')].map((n) => Number(n.dataset.n))])), [...f.querySelectorAll('.measures [data-n]')].map((n) => Number(n.dataset.n))]))
      for (const [n, found, all] of indices) {
        const c = result.characteristics[n]
        for (const index of ['cp', 'cpk', 'pp', 'ppk']) assert.deepEqual(found[index], c[index] ? [c[index].value, c[index].low, c[index].high] : [], `${c.id} ${index}`)
        for (const value of [c.mean, c.min, c.max, c.std_dev, c.std_dev_within, c.control?.moving_range, c.measured]) if (value !== null && value !== undefined) assert.ok(all.includes(value), `${c.id} ${value}`)
      }
      const still = await session.report('trend', { scripts: false })
      assert.equal(await still.locator('.chart .plot').count(), result.characteristics.length)
      const text = await still.locator('body').innerText()
      for (const word of ['0.33', 'beyond a control limit', 'A material requirement allows each part', 'The values do not vary', '<b>"x"&\'', 'part-010.stl', '↑ limit 5']) assert.ok(text.includes(word), word)
      assert.equal(await still.locator('b').count(), 0, 'a name is no markup')
      await still.locator('.overview a[href="#course-3"]').click()
      const seen = await still.evaluate(() => document.getElementById('course-3').getBoundingClientRect().top)
      assert.ok(seen >= 0 && seen < 700, `${seen}`)
    },
  ],
  [
    'the worst stands first, and what does not pass leads to its chart',
    async (session) => {
      const page = await session.report('trend', { live: false })
      await page.waitForSelector('.stage.live')
      const rows = await page.locator('.parts tbody tr').evaluateAll((all) => all.map((r) => Number(r.dataset.pick)))
      assert.deepEqual(rows.slice(0, 3), [10, 4, 6])
      assert.deepEqual(rows.slice(3), [0, 1, 2, 3, 5, 7, 8, 9, 11, 12, 13])
      assert.equal(await page.locator('.overview tbody tr').first().getAttribute('data-of'), '0')
      assert.match(await page.locator('.parts tbody tr').first().innerText(), /height/)
      await page.locator('.parts tbody tr').first().locator('a[href="#course-0"]').click()
      assert.equal(await page.evaluate(() => location.hash), '#course-0')
    },
  ],
  [
    'a row leads to its part in every chart, a dot to its row, arrow keys go from part to part',
    async (session) => {
      const page = await session.report('trend', { live: false })
      await page.waitForSelector('.stage.live')
      const { result } = await manifest(page)
      const lines = () => page.evaluate(() => [...document.querySelectorAll('.chart .plot .at')].map((p) => Number(p.getAttribute('d').match(/^M([\d.]+)/)[1])))
      await page.locator('.parts tr[data-pick="4"]').click()
      const at = await lines()
      assert.equal(at.length, result.characteristics.length)
      for (const x of at) close(x / 1000, 4.5 / 14, 'the line of the part')
      const box = await page.locator('#course-0 .plot').boundingBox()
      await page.mouse.move(box.x + (box.width * 10.5) / 14, box.y + 50)
      const said = await page.locator('#readout').innerText()
      for (const word of ['11 · part-010.stl', 'height', '10.2100 mm', 'Fail']) assert.ok(said.includes(word), said)
      await page.mouse.click(box.x + (box.width * 10.5) / 14, box.y + 50)
      assert.equal(await page.locator('.parts tr[data-pick="10"]').getAttribute('aria-selected'), 'true')
      await page.locator('#course-0 .plot').focus()
      await page.keyboard.press('ArrowRight')
      assert.equal(await page.locator('.parts tr[data-pick="11"]').getAttribute('aria-selected'), 'true')
      await page.keyboard.press('Escape')
      assert.deepEqual(await lines(), [])
    },
  ],
  [
    'no label of a chart lies over another, at any width and in every language, and nothing is cut',
    async (session) => {
      for (const width of [1440, 1000, 390]) {
        const page = await session.report('trend', { width, height: 900, live: false })
        await page.waitForSelector('.stage.live')
        for (const language of ['en', 'de', 'ru', 'zh-Hans']) {
          await page.locator('#tools select').selectOption(language)
          const bad = await page.evaluate(() => {
            const found = []
            for (const chart of document.querySelectorAll('.chart')) {
              for (const css of ['.gutter text', '.values text', '.numbers-of-parts text']) {
                const boxes = [...chart.querySelectorAll(css)].map((t) => [t.textContent, t.getBoundingClientRect()])
                boxes.forEach(([text, a], i) => {
                  if (a.right > innerWidth || a.left < 0) found.push(`${css} ${text} is cut`)
                  for (const [other, b] of boxes.slice(i + 1)) if (a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 2 && b.top < a.bottom - 2) found.push(`${css} ${text} over ${other}`)
                })
              }
              const body = chart.getBoundingClientRect()
              for (const e of chart.querySelectorAll('.measures div, .signals td, figcaption > *')) if (e.getBoundingClientRect().right > body.right + 1) found.push(`${e.className} ${e.textContent} is cut`)
            }
            for (const cell of document.querySelectorAll('.overview td, .overview th')) if (cell.getBoundingClientRect().right > innerWidth) found.push(`${cell.textContent} is cut`)
            return found
          })
          assert.deepEqual(bad, [], `${width} ${language}`)
        }
        await session.tidy()
      }
    },
  ],
  [
    'paper: charts are whole and light',
    async (session) => {
      const page = await session.report('trend', { width: 800, height: 1100, live: false, colorScheme: 'dark' })
      await page.waitForSelector('.stage.live')
      const pages = (await page.pdf({ format: 'A4', printBackground: true })).toString('latin1').match(/\/Type\s*\/Page\b/g).length
      assert.ok(pages <= 6, `${pages} pages`)
      await page.emulateMedia({ media: 'print' })
      assert.equal(await page.evaluate(() => [...document.querySelectorAll('.chart .plot')].filter((p) => p.getBoundingClientRect().height > 200).length), 6)
      assert.deepEqual(await token(page, '--paper'), [255, 255, 255])
    },
  ],
]
