// What is written is seen in whole: signs and digits of numbers, words of verdicts, names.
import assert from 'node:assert/strict'
import { hex, screen } from '../browser.mjs'

const LANGUAGES = ['en', 'de', 'ru', 'zh-Hans']
const WIDE = { width: 1600, height: 1000 }
/** With the stored picture: tables and scale lie as they do beside the part, which takes long to be drawn. */
const PLAIN = { ...WIDE, live: false, init: () => (HTMLCanvasElement.prototype.getContext = () => null) }
const A4 = { width: 703, height: 1000 }
const speak = (page, language) => page.locator('#tools select').selectOption(language)

/** Texts that reach out of what shows them, tables that are wider than the list, and flags on paper that are narrower than what they say. */
const cutIn = (page) =>
  page.evaluate(() => {
    const found = []
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT)
    for (let node = walker.nextNode(); node; node = walker.nextNode()) {
      const own = node.parentElement
      if (!node.data.trim() || own.closest('script, .unseen, select') || !own.checkVisibility({ visibilityProperty: true })) continue
      const range = document.createRange()
      range.selectNodeContents(node)
      const box = range.getBoundingClientRect()
      for (let around = own.closest(':not(text, tspan)'); around !== document.body; around = around.parentElement) {
        const { overflowX, textOverflow } = getComputedStyle(around)
        const { left, right } = around.getBoundingClientRect()
        // What ends with dots has all of it in its title.
        const dots = textOverflow === 'ellipsis' && around.closest('[title]')
        if (overflowX !== 'visible' && !dots && (box.left < left - 0.5 || box.right > right + 0.5)) found.push(node.data)
      }
    }
    const list = document.querySelector('.list')
    if (list.scrollWidth > list.clientWidth) found.push(`the list: ${list.scrollWidth} of ${list.clientWidth}`)
    for (const table of document.querySelectorAll('.list table')) {
      const [own, around] = [table, table.parentElement].map((e) => e.getBoundingClientRect())
      if (own.right > around.right + 0.5) found.push(`a table: ${own.width} of ${around.width}`)
    }
    for (const box of document.querySelectorAll('.flagged rect')) {
      const text = [box, ...[1, 2, 3].map((n) => box.parentElement.children[[...box.parentElement.children].indexOf(box) + n])].findLast((e) => e?.tagName === 'text')
      if (text && text.getBBox().x + text.getBBox().width > box.getBBox().x + box.getBBox().width - 4) found.push(`a flag: ${text.textContent}`)
    }
    return found
  })

/** What a report says in its manifest, with another scale. */
const scaled = (lower, upper, tolerance, decimals) => (html) =>
  html.replace(/(id="manifest">)(.*?)(<\/script>)/s, (_, begin, text, end) => {
    const manifest = JSON.parse(text)
    Object.assign(manifest.scale, { lower, upper, tolerance, decimals })
    return begin + JSON.stringify(manifest).replaceAll('<', '\\u003c') + end
  })

/** The labels beside the scale that lie on it in whole, clear of its strip. */
const labels = (page) =>
  page.evaluate(() => {
    const drawing = document.querySelector('.chart svg').getBoundingClientRect()
    const strip = document.querySelector('.chart .band').getBoundingClientRect().left
    const whole = (t) => t.getBoundingClientRect().left >= drawing.left && t.getBoundingClientRect().right <= strip
    return [...document.querySelectorAll('.chart text.tick')].filter(whole).map((t) => t.textContent)
  })

/** A section as the pages of comparisons and plans have it, by which regions are judged. */
const regions = (html) => {
  const row = ([name, verdict]) =>
    `<tr><th scope="row"><bdi class="name">${name}</bdi></th><td class="r">−0.0200<br>+0.0500</td><td class="r">1,362,272</td><td class="r">100.00 %</td>
     <td><span class="verdict v-fail"><span class="icon">✕</span> <span data-t="verdict.${verdict}">?</span></span></td></tr>`
  const rows = [['bore', 'not_measured'], ['nowhere', 'undecided'], ['the upper end of the left flange', 'fail']].map(row).join('')
  const heads = ['region', 'tolerance', 'points', 'within.short'].map((key, n) => `<th${n ? ' class="r"' : ''}><span data-t="${key}"></span></th>`).join('')
  return html.replace('<section class="block b-statistics">', `<section class="block b-regions"><table class="statistics"><thead><tr>${heads}<th></th></tr></thead><tbody>${rows}</tbody></table></section>$&`)
}

export const cut = [
  [
    'the labels of the scale keep every sign and digit, in four languages',
    async (session) => {
      const cases = [
        [[-100, 100, [-50, 50], 3], { en: ['+50.000', '−100.000'], de: ['+50,000', '−100,000'], ru: ['+50,000', '−100,000'], 'zh-Hans': ['+50.000', '−100.000'] }],
        [[-0.0002, 0.0002, [-0.0001, 0.0001], 6], { en: ['+0.000100', '−0.000200'], de: ['+0,000100', '−0,000200'] }],
        [[-12345.678, 12345.678, [-1000, 1000], 3], { en: ['+12,345.678', '−1,000.000'], de: ['+12.345,678', '−1.000,000'], ru: ['+12\u00a0345,678', '−1\u00a0000,000'] }],
        [[-1e9, 1e9, null, 9], { en: ['+1,000,000,000.000000000', '−1,000,000,000.000000000'], ru: ['+1\u00a0000\u00a0000\u00a0000,000000000'] }],
      ]
      for (const [scale, expected] of cases) {
        const page = await session.report('sphere', { ...PLAIN, edit: scaled(...scale) })
        for (const [language, texts] of Object.entries(expected)) {
          await speak(page, language)
          await page.waitForTimeout(100)
          const shown = await labels(page)
          for (const text of texts) assert.ok(shown.includes(text), `${text} in ${shown}`)
          assert.deepEqual(await cutIn(page), [], language)
        }
      }
    },
  ],
  [
    'no word, number or name of a list is cut, in four languages and on paper',
    async (session) => {
      for (const [name, edit] of [['sphere', regions], ['sphere_points'], ['four'], ['plan_kinds', regions], ['surface'], ['defects']]) {
        const page = await session.report(name, { ...PLAIN, edit })
        for (const language of LANGUAGES) {
          await speak(page, language)
          assert.deepEqual(await cutIn(page), [], `${name} ${language}`)
        }
        await page.setViewportSize(A4)
        await page.emulateMedia({ media: 'print' })
        for (const language of LANGUAGES) {
          await page.evaluate((language) => {
            const select = document.querySelector('#tools select')
            select.value = language
            select.dispatchEvent(new Event('change'))
          }, language)
          assert.deepEqual(await cutIn(page), [], `${name} ${language} on paper`)
        }
      }
    },
  ],
  [
    'verdicts of regions and references are read in whole, and names in one line',
    async (session) => {
      const named = (html) => html.replaceAll('>fine.stl<', '>zipper_res1.ply<')
      const four = await session.report('four', { ...PLAIN, edit: named })
      await speak(four, 'de')
      const lines = await four.evaluate(() => [...document.querySelectorAll('.b-ranking td .name')].map((e) => [e.textContent, e.getBoundingClientRect().height / parseFloat(getComputedStyle(e).lineHeight)]))
      assert.deepEqual(lines.map(([text]) => text), Array(4).fill('zipper_res1.ply'))
      for (const [, height] of lines) assert.ok(height < 1.5, `${height} lines`)
      assert.match(await four.locator('.b-ranking tbody tr').first().innerText(), /✕\sNicht in Ordnung\s+33,29\s%/)
      const page = await session.report('sphere', { ...PLAIN, edit: regions })
      for (const [language, ...words] of [['en', 'Not measured', 'Undecided', 'Fail'], ['de', 'Nicht gemessen', 'Nicht entscheidbar', 'Nicht in Ordnung']]) {
        await speak(page, language)
        const rows = await page.locator('.b-regions tbody tr').allInnerTexts()
        words.forEach((word, n) => assert.ok(rows[n].replace(/\s+/g, ' ').includes(word), rows[n]))
      }
    },
  ],
  [
    'the sign of a verdict stands out from its ground, in light and dark',
    async (session) => {
      for (const [verdict, sign] of [['pass', '✓'], ['fail', '✕'], ['undecided', '?'], ['not_measured', '–'], ['not_judged', 'i']]) {
        const edit = (html) => html.replace(/<h1><span class="verdict v-fail">(<span class="icon"[^>]*>)✕/, `<h1><span class="verdict v-${verdict}">$1${sign}`)
        const page = await session.report('sphere', { edit, scripts: false })
        for (const colorScheme of ['light', 'dark']) {
          await page.emulateMedia({ colorScheme })
          const box = await page.locator('h1 .icon').boundingBox()
          assert.equal(await page.locator('h1 .icon').innerText(), sign)
          const picture = await screen(page)
          const colors = new Map()
          for (let x = box.x + 0.2 * box.width; x < box.x + 0.8 * box.width; x++)
            for (let y = box.y + 0.2 * box.height; y < box.y + 0.8 * box.height; y++) {
              const color = hex(picture.at(x, y))
              colors.set(color, (colors.get(color) ?? 0) + 1)
            }
          assert.ok(colors.size > 3, `${sign}: ${[...colors.keys()]}`)
        }
      }
    },
  ],
  [
    'a flag on paper is as wide as what it says, with its note',
    async (session) => {
      for (const [name, language, note] of [['behind', 'de', /^\d\u2002[+−]\d+,\d{3} · neben dem Teil$/], ['behind', 'en', /^\d\u2002[+−]\d+\.\d{3} · off the part$/], ['plan', 'de', null]]) {
        const page = await session.report(name, WIDE)
        await speak(page, language)
        await page.evaluate(() => window.dispatchEvent(new Event('beforeprint')))
        await page.emulateMedia({ media: 'print' })
        const texts = await page.locator('.flagged text').allTextContents()
        assert.ok(texts.length > 4 && (note === null || texts.some((text) => note.test(text))), texts.join(' | '))
        assert.deepEqual(await cutIn(page), [], `${name} ${language}`)
      }
    },
  ],
  [
    'nothing says that the part is loading once it is there',
    async (session) => {
      for (const name of ['sphere', 'plan']) {
        const page = await session.report(name)
        assert.equal(await page.locator('.stage.live .notice').isVisible(), false)
      }
    },
  ],
]
