// Measured points against references that are far coarser than the points are apart.
import assert from 'node:assert/strict'
import { screen, settled, stageBox, tool } from '../browser.mjs'
import { view } from './colors.mjs'

const key = async (page, k) => {
  await page.keyboard.press(k)
  await settled(page)
}
const read = (page) => page.evaluate(() => ({ text: document.getElementById('readout').textContent, value: document.getElementById('readout').dataset.value }))
const shown = (page) => page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent).objects.filter((o) => o.shown).map((o) => o.role))
/** Low deviations are blue in this palette, high ones red. */
const blue = (c) => c[2] > c[0] + 40 && c[2] > c[1]
/** Coloured, and neither green nor green mixed with the ground at the rim of a point. */
const out = (c) => Math.max(...c) - Math.min(...c) > 40 && !(c[1] >= Math.max(c[0], c[2]) && c[2] - c[0] > -5 && c[2] - c[0] < 45)
const count = (picture, box, test) => {
  let n = 0
  for (let y = box.y; y < box.y + box.height; y += 2) for (let x = box.x; x < box.x + box.width; x += 2) n += Number(test(picture.at(x, y)))
  return n
}
/** The same page with the reference instead of the points. */
const onReference = async (page) => {
  if ((await shown(page)).includes('measured')) {
    await key(page, 'a')
    await key(page, 'n')
  }
}

export const clouds = [
  [
    'a dent between the vertices of a coarse cube: seen as points and on the reference',
    async (session) => {
      for (const reference of [false, true]) {
        const page = await session.report('dent')
        assert.deepEqual(await shown(page), ['measured'])
        await tool(page, 'Flat')
        await tool(page, 'Flags')
        if (reference) await onReference(page)
        await key(page, '5')
        const box = await stageBox(page)
        const perPixel = (await view(page)) / box.height
        const at = (x, y) => [Math.round(box.cx + (x - 10) / perPixel), Math.round(box.cy - (y - 10) / perPixel)]
        const worst = await page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent).result.comparisons[0].worst.find((w) => w.deviation < 0))
        await page.mouse.move(...at(...worst.point))
        const dent = await read(page)
        // The cursor is within a pixel of the worst point; the dent is deeper than 0.47 within half a millimetre, the noise 0.02.
        assert.ok(Number(dent.value) < -0.44 && Number(dent.value) >= worst.deviation - 1e-4 && worst.deviation > -0.53, `${dent.value}, worst ${worst.deviation}`)
        assert.match(dent.text, /out of tolerance/)
        assert.match(dent.text, reference ? /worst measured point near here/ : /measured point/)
        // Off the part, or the card beside the cursor lies over it.
        await page.mouse.move(5, 5)
        const picture = await screen(page)
        assert.ok(blue(picture.at(...at(...worst.point))), 'the dent')
        // Green elsewhere on the face, up to its edges.
        for (let x = 0.4; x < 20; x += 0.7)
          for (let y = 0.4; y < 20; y += 0.7)
            if (Math.hypot(x - 10, y - 10) > 3.6) assert.ok(!out(picture.at(...at(x, y))), `${x}, ${y}`)
        // On the reference every place reads; between points there is nothing to read.
        await page.mouse.move(...at(3, 4))
        const beside = await read(page)
        assert.match(beside.text, reference ? /within tolerance/ : /^$|within tolerance/)
        // The other faces stay green: no point of the top is theirs. (Between points one sees those behind.)
        for (const side of reference ? ['1', '2', '3', '4', '6'] : []) {
          await key(page, side)
          assert.equal(count(await screen(page), { x: box.cx - 4 / perPixel, y: box.cy - 4 / perPixel, width: 8 / perPixel, height: 8 / perPixel }, out), 0, `view ${side}`)
        }
        await session.tidy()
      }
    },
  ],
  [
    'where nothing was measured the reference is grey and says so',
    async (session) => {
      const page = await session.report('half_dent')
      await tool(page, 'Flat')
      await tool(page, 'Flags')
      await onReference(page)
      await key(page, '5')
      const box = await stageBox(page)
      const perPixel = (await view(page)) / box.height
      const at = (x, y) => [Math.round(box.cx + (x - 10) / perPixel), Math.round(box.cy - (y - 10) / perPixel)]
      await page.mouse.move(...at(16, 10))
      assert.match((await read(page)).text, /No value · no measured point nearby/)
      await page.mouse.move(5, 5)
      const picture = await screen(page)
      const grey = (c) => Math.max(...c) - Math.min(...c) < 20
      for (let y = 1; y < 20; y += 1) {
        assert.ok(grey(picture.at(...at(14, y))), `not measured at ${y}`)
        assert.ok(!grey(picture.at(...at(5, y))), `measured at ${y}`)
      }
      assert.ok(blue(picture.at(...at(10, 10))), 'the dent')
    },
  ],
  [
    'few points: the map is on the reference, with the worst of them',
    async (session) => {
      const page = await session.report('few')
      assert.deepEqual(await shown(page), ['reference'])
      await tool(page, 'Flags')
      const worst = await page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent).result.comparisons[0].worst.at(-3))
      assert.ok(worst.deviation < -0.2)
      await key(page, '5')
      const box = await stageBox(page)
      const perPixel = (await view(page)) / box.height
      await page.mouse.move(Math.round(box.cx + (worst.nearest[0] - 10) / perPixel), Math.round(box.cy - (worst.nearest[1] - 10) / perPixel))
      assert.ok(Math.abs(Number((await read(page)).value) - worst.deviation) < 1e-4)
    },
  ],
  [
    'the bunny: thousands of points out of tolerance are seen, as points and on the reference',
    async (session) => {
      const page = await session.report('bunny')
      assert.deepEqual(await shown(page), ['measured'])
      await tool(page, 'Flat')
      await tool(page, 'Flags')
      await page.mouse.move(5, 5)
      for (const reference of [false, true]) {
        if (reference) await onReference(page)
        const box = await stageBox(page)
        const picture = await screen(page)
        const colored = count(picture, box, (c) => Math.max(...c) - Math.min(...c) > 40)
        const bad = count(picture, box, out)
        assert.ok(bad > 0.02 * colored, `${bad} of ${colored}`)
      }
      assert.deepEqual(page.seen.errors, [])
    },
  ],
]
