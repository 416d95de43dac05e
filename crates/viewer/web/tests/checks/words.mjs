// Four languages, narrow and wide.
import assert from 'node:assert/strict'

/** A key that stands where its word should. */
const RAW = /\b(verdict|reason|scale|tool|stage|view|ends|keys|state|defect|about|severity|parameter|fit|touching|method|step|changes|facets|curvature|sign|picture|join|taken|segment|contour|layer|course|chart|rule|characteristic|parts|kind|level)\.[a-z]/

/** Elements whose content does not fit into them. */
const tooWide = (page) =>
  page.evaluate(() =>
    [...document.querySelectorAll('body, header, .list, .scale, .controls > *, .stage-tools > *, .key-numbers > *, .status')]
      .filter((e) => e.scrollWidth > e.clientWidth + 1 && e.clientWidth > 0)
      .map((e) => `${e.tagName}.${e.className} ${e.scrollWidth} > ${e.clientWidth}`),
  )

export const words = [
  [
    'four languages: no raw key, no overflow, decimals as written there',
    async (session) => {
      for (const [width, height] of [[1280, 800], [390, 844]]) {
        for (const name of ['defects', 'zone', 'mended', 'curvature', 'surface', 'section', 'stack', 'trend', 'trend_one']) {
          const page = await session.report(name, { width, height, live: false })
          for (const language of ['en', 'de', 'ru', 'zh-Hans']) {
            await page.locator('#tools select').selectOption(language)
            await page.evaluate(() => document.querySelectorAll('details').forEach((d) => (d.open = true)))
            assert.doesNotMatch(await page.locator('body').innerText(), RAW, `${name} ${language}`)
            assert.deepEqual(await tooWide(page), [], `${name} ${language} at ${width}`)
          }
        }
        const page = await session.report('sphere', { width, height })
        for (const [language, sign] of [['en', '33.67'], ['de', '33,67'], ['ru', '33,67'], ['zh-Hans', '33.67']]) {
          await page.locator('#tools select').selectOption(language)
          const text = await page.locator('body').innerText()
          assert.ok(text.includes(sign), `${language}: ${sign}`)
          assert.doesNotMatch(text, RAW, language)
          assert.deepEqual(await tooWide(page), [], `${language} at ${width}`)
        }
      }
    },
  ],
  [
    'every place of the page that a number stands in keeps the number with a point',
    async (session) => {
      const page = await session.report('sphere')
      const bad = await page.evaluate(() => [...document.querySelectorAll('[data-n]')].filter((e) => !Number.isFinite(Number(e.dataset.n))).length)
      assert.equal(bad, 0)
    },
  ],
]
