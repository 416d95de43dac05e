// An inspection: frames of characteristics with leaders, and the map of deviations in place of the features.
import assert from 'node:assert/strict'
import { near, screen, settled, stageBox, tool } from '../browser.mjs'

const manifest = (page) => page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent))
const STILL = { reducedMotion: 'reduce', width: 1440, height: 900 }

/** Frames or flags that are shown: text, classes, and where the leader ends. */
const shown = (page) =>
  page.evaluate(() => {
    const dots = [...document.querySelectorAll('.leaders .anchor')]
    return [...document.querySelectorAll('.flag')].map((flag, n) => {
      const box = dots[n].getBoundingClientRect()
      return {
        cells: [...flag.querySelectorAll('.cell')].map((c) => c.textContent),
        signs: flag.querySelectorAll('.cell svg').length,
        value: flag.querySelector('strong').textContent,
        classes: [...flag.classList],
        x: box.x + box.width / 2,
        y: box.y + box.height / 2,
        hidden: flag.classList.contains('hidden'),
        id: flag.querySelector('.number').textContent,
        there: ((f, s) => f.width > 60 && f.left >= s.left && f.right <= s.right)(flag.getBoundingClientRect(), document.getElementById('stage').getBoundingClientRect()),
      }
    })
  })

/** The characteristic that a pick leads to. */
const about = (result, pick) => result.characteristics.find((c) => c.anchor.every((x, k) => x === pick.position[k]) && c.value === pick.frame.value && c.datums.length === pick.frame.datums.length)

const bytes = (color) => [0, 2, 4].map((k) => parseInt(color.slice(k, k + 2), 16))
const along = (c) => c.map((x) => x / Math.hypot(...c))

export const inspect = [
  [
    'every characteristic has its frame: sign, tolerance, datums, value and verdict as in the result',
    async (session) => {
      const page = await session.report('plan', STILL)
      const { result, picks } = await manifest(page)
      const frames = await shown(page)
      assert.equal(frames.length, 3)
      const wanted = {
        flatness: { cells: ['', '0.05'], signs: 1 },
        distance: { cells: ['9.95\u2009…\u200910.05', 'A'], signs: 0 },
        perpendicularity: { cells: ['', '0.05', 'A'], signs: 1 },
      }
      for (const [n, frame] of frames.entries()) {
        const c = about(result, picks[n])
        assert.deepEqual({ cells: frame.cells, signs: frame.signs }, wanted[c.kind])
        assert.equal(Number(frame.value), Number(c.value.toFixed(4)))
        assert.ok(frame.classes.includes(c.verdict), `${frame.classes} is not ${c.verdict}`)
        assert.equal(frame.id, c.id)
        assert.ok(frame.there, 'it is not within the stage')
      }
      // What fails comes first.
      assert.equal(frames[0].value, '10.0800')
      assert.ok(frames[0].classes.includes('fail'))
    },
  ],
  [
    'frames and rows name degrees, sizes and parameters, and no uncertainty of a value that is not there',
    async (session) => {
      const page = await session.report('plan_kinds', STILL)
      const frames = new Map((await shown(page)).map((f) => [f.id, f]))
      const rows = await page.evaluate(() => Object.fromEntries([...document.querySelectorAll('.b-characteristics [data-pick]')].map((row) => [row.querySelector('.name').textContent, [...row.cells].map((c) => c.innerText.replace(/[\s\u00a0]+/g, ' '))])))
      assert.deepEqual([frames.get('4').cells, frames.get('4').value], [['89.5\u2009…\u200990.5°', 'A'], '89.750°'])
      assert.deepEqual(frames.get('5').cells, ['9.95\u2009…\u200910.05\u00a0GX'])
      assert.deepEqual(frames.get('6').cells, ['Sq\u00a00.05'])
      assert.deepEqual(rows['4'].slice(0, 2), ['4 Angle top | A', '89.750° ± 0.125° 89.500 … 90.500°'])
      assert.equal(rows['5'][0], '5 Size GX top')
      assert.equal(rows['6'][0], '6 Surface texture Sq top')
      assert.equal(rows['1'][1], '– ≤ 0.0500')
    },
  ],
  [
    'a leader ends on its feature, which has the colour of the verdict',
    async (session) => {
      const page = await session.report('plan', STILL)
      const { objects, result, picks } = await manifest(page)
      const picture = await screen(page)
      const frames = await shown(page)
      assert.ok(frames.filter((f) => !f.hidden).length >= 2)
      for (const [n, frame] of frames.entries()) {
        if (frame.hidden) continue
        const c = about(result, picks[n])
        const worst = result.characteristics.some((o) => o.feature === c.feature && o.verdict === 'fail') ? 'fail' : 'pass'
        const color = bytes(objects.find((o) => o.name === c.feature).color)
        assert.deepEqual(color, { fail: [0xc1, 0x1f, 0x2b], pass: [0x11, 0x6b, 0x2e] }[worst])
        // Around the dot at its end; light and shade change no hue.
        const around = [[9, 0], [-9, 0], [0, 9], [0, -9], [7, 7], [-7, -7], [7, -7], [-7, 7]].map(([dx, dy]) => picture.at(frame.x + dx, frame.y + dy))
        assert.ok(around.some((p) => near(along(p), along(color), 0.12)), `${c.id}: ${around} has nothing of ${color}`)
      }
    },
  ],
  [
    'the faces stand in place of the features: each facet once, each feature in a color of its own, edges gray',
    async (session) => {
      const page = await session.report('plan', STILL)
      const { objects, picks, result } = await manifest(page)
      const faces = objects.filter((o) => o.role === 'partition')
      const part = objects.filter((o) => o.role === 'part')
      const count = (all) => all.reduce((n, o) => n + o.triangles, 0)
      assert.ok(faces.length > 2 && faces.every((o) => !o.shown))
      assert.equal(count(faces), count(part))
      const ids = result.features.map((f) => f.id)
      const own = faces.filter((o) => ids.includes(o.name))
      assert.deepEqual(own.map((o) => o.name).sort(), [...ids].sort())
      assert.equal(new Set(own.map((o) => o.color)).size, ids.length)
      await tool(page, 'Faces')
      await settled(page)
      assert.equal(await page.locator('#scale').isVisible(), false)
      const picture = await screen(page)
      for (const [n, frame] of (await shown(page)).entries()) {
        if (frame.hidden) continue
        const color = bytes(own.find((o) => o.name === about(result, picks[n]).feature).color)
        const around = [[9, 0], [-9, 0], [0, 9], [0, -9], [7, 7], [-7, -7], [7, -7], [-7, 7]].map(([dx, dy]) => picture.at(frame.x + dx, frame.y + dy))
        assert.ok(around.some((p) => near(along(p), along(color), 0.12)), `${frame.id}: ${around} has nothing of ${color}`)
      }
      // One key swaps them.
      await page.keyboard.press('o')
      await settled(page)
      assert.equal(await page.locator('.stage-tools button[aria-pressed="true"]').first().textContent(), 'Part')
    },
  ],
  [
    'the map stands in place of the features, with its scale and flags, and only then',
    async (session) => {
      const page = await session.report('plan', STILL)
      assert.equal(await page.locator('#scale').isVisible(), false)
      await tool(page, 'Deviation')
      await settled(page)
      assert.equal(await page.locator('#scale').isVisible(), true)
      const flags = await shown(page)
      assert.ok(flags.length > 0 && flags.every((f) => f.value === '+0.080' && f.classes.includes('out') && f.cells.length === 0), JSON.stringify(flags))
      // From above every place is 0.08 too high; from below none is off.
      for (const [view, value] of [['5', '+0.080'], ['6', '0.000']]) {
        await page.keyboard.press(view)
        await settled(page)
        const box = await stageBox(page)
        await page.mouse.move(box.cx + 1, box.cy + 1)
        await page.mouse.move(box.cx, box.cy)
        await page.waitForSelector('.hover:not([hidden])')
        assert.match(await page.locator('.hover').first().textContent(), new RegExp(value.replace('+', '\\+')))
      }
      await tool(page, 'Part')
      await settled(page)
      assert.equal(await page.locator('#scale').isVisible(), false)
      assert.equal((await shown(page)).filter((f) => f.cells.length > 0).length, 3)
    },
  ],
  [
    'a row of the list shows what it is about: features for a characteristic, the map for a deviation',
    async (session) => {
      const page = await session.report('plan', STILL)
      const { picks } = await manifest(page)
      const valued = picks.findIndex((p) => p.value !== null)
      await page.locator(`tr[data-pick="${valued}"]`).click()
      await settled(page)
      assert.equal(await page.locator('#scale').isVisible(), true)
      await page.locator('tr[data-pick="0"]').click()
      await settled(page)
      assert.equal(await page.locator('#scale').isVisible(), false)
    },
  ],
  [
    'material requirements stand in circles, and a frame has its tolerance without the bonus',
    async (session) => {
      const page = await session.report('plan_material', STILL)
      const cells = (await shown(page)).map((f) => f.cells)
      assert.ok(cells.some((c) => c.join('|') === '|⌀0.05M|AL'), JSON.stringify(cells))
      const round = await page.evaluate(() => [...document.querySelectorAll('.circled')].map((e) => [e.textContent, e.getBoundingClientRect(), getComputedStyle(e)]).map(([text, box, style]) => [text, box.width / box.height, style.borderRadius, style.borderStyle]))
      // In its frame and in the list: the letters of the datum and of the tolerance.
      assert.deepEqual(round.map(([text]) => text).toSorted(), ['L', 'L', 'M', 'M'])
      for (const [text, ratio, radius, style] of round) assert.ok(Math.abs(ratio - 1) < 0.15 && radius === '50%' && style === 'solid', `${text} ${ratio} ${radius} ${style}`)
      const row = await page.locator('#list tr', { hasText: /Perpen\u00addicu\u00adlarity/ }).textContent()
      assert.ok(row.includes('⌀0.0700 (0.0500\u00a0M)'), row)
    },
  ],
  [
    'without scripts the stored picture has the frames and no scale of what it does not show',
    async (session) => {
      const page = await session.report('plan', { ...STILL, scripts: false })
      const texts = await page.evaluate(() => [...document.querySelectorAll('#flagged text.frame')].map((t) => t.textContent))
      assert.deepEqual(texts.toSorted(), ['0.05 | A\u20020.0000', '0.05\u20020.0000', '9.95\u2009…\u200910.05 | A\u200210.0800'].toSorted())
      assert.equal(await page.locator('#figure').isVisible(), false)
    },
  ],
]
