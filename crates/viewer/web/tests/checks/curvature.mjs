// Curvatures: four maps with a scale of their own, each with the exact value under every pixel.
import assert from 'node:assert/strict'
import { near, screen, settled, stageBox, tool } from '../browser.mjs'

const manifest = (page) => page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent))

/** Curvatures of the torus of radii 10 and 4 at a place: mean, Gaussian, greater, lesser. */
function known([x, y]) {
  const rho = Math.hypot(x, y)
  const around = -(rho - 10) / (4 * rho)
  return [(around - 0.25) / 2, around * -0.25, around, -0.25]
}

/** Curvatures of z = x² / 80 − y² / 120 at a place, in the same order; its normal points up. */
function bent([x, y]) {
  const [fx, fy, xx, yy] = [x / 40, -y / 60, 1 / 40, -1 / 60]
  const w = Math.sqrt(1 + fx * fx + fy * fy)
  const mean = ((1 + fy * fy) * xx + (1 + fx * fx) * yy) / (2 * w ** 3)
  const gaussian = (xx * yy) / w ** 4
  const spread = Math.sqrt(mean * mean - gaussian)
  return [mean, gaussian, mean + spread, mean - spread]
}

/** Shows a map by the chooser over the stage. */
async function show(page, n) {
  await page.locator('.stage-tools select').selectOption(String(n))
  await settled(page)
}

/** What the cursor reads at a pixel: value and place; null where there is none. */
async function read(page, x, y) {
  await page.mouse.move(x, y)
  return page.evaluate(() => {
    const line = document.getElementById('readout')
    const place = /x (\S+) y (\S+) z (\S+)$/.exec(line.textContent)
    if (!line.dataset.value || !place) return null
    return { value: Number(line.dataset.value), place: place.slice(1).map((t) => Number(t.replace('\u2212', '-'))) }
  })
}

/** Pixels by chance, in the middle of the stage. */
async function pixels(page, length = 160) {
  const box = await stageBox(page)
  let seed = 7
  const chance = () => (seed = (seed * 48271) % 2147483647) / 2147483647
  return Array.from({ length }, () => [box.x + 160 + chance() * (box.width - 320), box.y + 60 + chance() * (box.height - 120)].map(Math.round))
}

/** Compares maps, from number `first` on, at pixels by chance: the value read with the exact one, the color with the value's. */
async function agree(page, maps, exact, most, first) {
  const places = await pixels(page)
  for (const [n, map] of maps.entries()) {
    await show(page, first + n)
    const { lower, upper, unit } = map.scale
    assert.match(await page.locator('.scale .axis').innerText(), new RegExp(`/ ${unit}$`))
    // The card at the cursor is no part of the picture.
    await page.mouse.move(2, 2)
    const picture = await screen(page)
    const bands = [...map.palettes.inspect.bands.matchAll(/(..)(..)(..)/g)].map((c) => c.slice(1).map((x) => parseInt(x, 16)))
    let met = 0
    for (const [x, y] of places) {
      const found = await read(page, x, y)
      if (!found) continue
      const want = exact(found.place)[n]
      assert.ok(Math.abs(found.value - want) < most[n], `${map.name} at ${found.place}: ${found.value}, exact ${want}`)
      met++
      // In the middle of a band: at its limits the next pixel may have another color.
      const at = ((found.value - lower) / (upper - lower)) * 9
      if (at < 0 || at > 9 || Math.abs(at - Math.floor(at) - 0.5) > 0.35) continue
      const color = bands[1 + Math.floor(at)]
      assert.ok(near(picture.at(x, y), color, 3), `${map.name} ${found.value}: ${picture.at(x, y)} is not ${color}`)
    }
    assert.ok(met > 40, `${met} pixels`)
  }
}

export const curvature = [
  [
    'each map reads the exact curvature at pixels by chance, and its colour is that of its own scale',
    async (session) => {
      const page = await session.report('curvature', { reducedMotion: 'reduce' })
      await tool(page, 'Flat')
      await page.keyboard.press('5')
      await settled(page)
      const { maps, palettes } = await manifest(page)
      assert.deepEqual(maps.map((m) => m.name), ['mean', 'gaussian', 'k1', 'k2'])
      assert.ok(palettes)
      await agree(page, maps, known, [0.003, 0.001, 0.003, 0.003], 0)
      assert.deepEqual(page.seen.errors, [])
    },
  ],
  [
    'a map brings its numbers, its extreme places and its words with it',
    async (session) => {
      const page = await session.report('curvature', { reducedMotion: 'reduce' })
      const { result } = await manifest(page)
      const shown = () => page.evaluate(() => [...document.querySelectorAll('[data-comparison]')].filter((e) => !e.hidden).map((e) => e.textContent).join(' '))
      assert.match(await shown(), /Mean curvature/)
      await show(page, 1)
      assert.match(await shown(), /Gaussian curvature/)
      assert.match(await page.locator('.scale').innerText(), /saddle/)
      assert.equal(await page.locator('.flag').count(), 2)
      const most = result.gaussian.maximum.gaussian.toFixed(result.gaussian.scale.decimals)
      assert.ok((await page.locator('.flag').first().innerText()).includes(most), most)
      // Back again: the first scale.
      await show(page, 0)
      const ticks = await page.locator('.chart text.tick').allTextContents()
      assert.ok(ticks.some((t) => t.includes(String(result.mean.scale.upper))), ticks.join(' '))
      assert.match(await page.locator('.scale').innerText(), /hollow/)
    },
  ],
  [
    'a cloud is coloured point by point, and what has no value says why',
    async (session) => {
      const page = await session.report('curvature_cloud', { reducedMotion: 'reduce' })
      await page.keyboard.press('5')
      await settled(page)
      const box = await stageBox(page)
      let met = 0
      for (let k = 0; k < 60; k++) {
        const found = await read(page, Math.round(box.x + 160 + (k * (box.width - 320)) / 60), Math.round(box.cy + 37))
        // Discs of points reach a little beyond the body's outline.
        if (!found || Math.abs(Math.hypot(Math.hypot(found.place[0], found.place[1]) - 10, found.place[2]) - 4) > 0.1) continue
        // The pixel may lie half the spacing of the points from the point whose disc it shows.
        assert.ok(Math.abs(found.value - known(found.place)[0]) < 0.012, `${found.value} at ${found.place}`)
        met++
      }
      assert.ok(met > 15, `${met}`)
      const half = await session.report('curvature_half', { reducedMotion: 'reduce' })
      assert.match(await half.locator('.b-without').innerText(), /the surface ends there\s+\d/)
      const { objects } = await manifest(half)
      assert.ok(Object.values(objects[0].fields[0].no_value).includes('boundary'))
    },
  ],
  [
    'with scripts off: the first map as a picture, its scale, the extreme places',
    async (session) => {
      const page = await session.report('curvature', { scripts: false })
      assert.match(await page.locator('header').innerText(), /Curvature/)
      assert.equal(await page.locator('table.pick').first().locator('tbody tr').count(), 2)
      assert.ok(await page.locator('#figure svg').isVisible())
    },
  ],
  [
    'a fitted surface: exact curvatures under the pixels, points with their deviations in the first map alone',
    async (session) => {
      const page = await session.report('surface', { reducedMotion: 'reduce' })
      const { maps, result } = await manifest(page)
      assert.deepEqual(maps.map((m) => m.name), ['deviation', 'mean', 'gaussian', 'k1', 'k2'])
      // Points lie 0.02 above and below by turns; the cursor reads the value of the point whose disc it is over.
      await page.keyboard.press('5')
      await settled(page)
      const signs = { '-1': 0, 1: 0 }
      for (const [x, y] of await pixels(page)) {
        const found = await read(page, x, y)
        // At the border the surface follows single points.
        if (!found || Math.abs(found.place[0]) > 27 || Math.abs(found.place[1]) > 17) continue
        // Discs of neighbors lie over one another: which of them is seen is not known, but both are as far from the surface.
        const want = 0.02 / Math.hypot(1, found.place[0] / 40, found.place[1] / 60)
        assert.ok(Math.abs(Math.abs(found.value) - want) < 5e-4, `${found.value} at ${found.place}, exact ${want}`)
        signs[Math.sign(found.value)]++
      }
      assert.ok(signs[-1] > 10 && signs[1] > 10, JSON.stringify(signs))
      // Lines and marks away: what is left is the surface.
      await page.keyboard.press('e')
      await tool(page, 'Flat')
      await agree(page, maps.slice(1), bent, [4e-4, 2e-5, 4e-4, 4e-4], 1)
      // At right angles to a sloping surface 0.02 mm of height are less.
      let sum = 0
      for (let i = 0; i <= 120; i++) for (let j = 0; j <= 80; j++) sum += 4e-4 / (1 + ((i / 2 - 30) / 40) ** 2 + ((j / 2 - 20) / 60) ** 2)
      const rms = Math.sqrt(sum / (121 * 81))
      assert.ok(Math.abs(result.deviation.rms - rms) < 3e-4, `${result.deviation.rms} ${rms}`)
      assert.deepEqual(page.seen.errors, [])
    },
  ],
  [
    'a fitted surface: lines at the knots are there, the control net when asked for',
    async (session) => {
      const page = await session.report('surface', { reducedMotion: 'reduce' })
      await show(page, 1)
      await page.keyboard.press('5')
      await settled(page)
      const box = await stageBox(page)
      const count = async (wanted) => {
        const picture = await screen(page)
        let found = 0
        for (let y = box.y + 60; y < box.y + box.height - 10; y += 2) for (let x = box.x + 10; x < box.x + box.width - 120; x += 2) found += wanted(picture.at(x, y)) ? 1 : 0
        return found
      }
      const dark = ([r, g, b]) => Math.max(r, g, b) < 70
      const violet = ([r, g, b]) => b > 150 && r > 60 && r < 140 && g < 110
      const lines = await count(dark)
      assert.ok(lines > 150, `${lines}`)
      await page.keyboard.press('e')
      await settled(page)
      assert.ok((await count(dark)) < lines / 5)
      const before = await count(violet)
      await page.keyboard.press('d')
      await settled(page)
      assert.ok((await count(violet)) > before + 100, `${before}`)
    },
  ],
]
