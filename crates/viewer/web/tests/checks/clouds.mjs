// Measured points against references that are far coarser than the points are apart.
import assert from 'node:assert/strict'
import { decode, screen, settled, stageBox, tool } from '../browser.mjs'
import { view } from './colors.mjs'

const key = async (page, k) => {
  await page.keyboard.press(k)
  await settled(page)
}
const read = (page) => page.evaluate(() => ({ text: document.getElementById('readout').textContent, value: document.getElementById('readout').dataset.value }))
const shown = (page) => page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent).objects.filter((o) => o.shown).map((o) => o.role))
/** Low deviations are blue in this palette, high ones red. */
const blue = (c) => c[2] > c[0] + 40 && c[2] > c[1]
/** Colored, and neither green nor green mixed with the ground at the rim of a point. */
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

const manifest = (page) => page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent))
/** Which way a place on the cube from 0 to 20 looks: its nearest face. */
const faceOf = (p) => {
  const [axis, low] = [0, 1, 2].flatMap((k) => [[k, true], [k, false]]).reduce((a, b) => (off(p, b) < off(p, a) ? b : a))
  return [0, 1, 2].map((k) => (k === axis ? (low ? -1 : 1) : 0))
}
const off = (p, [axis, low]) => Math.abs(p[axis] - (low ? 0 : 20))
const looksHere = (p, toward) => faceOf(p).reduce((sum, n, k) => sum + n * toward[k], 0) > 0
const flags = (page) =>
  page.evaluate(() =>
    [...document.querySelectorAll('.flag')].map((box, i) => ({
      hidden: box.classList.contains('hidden'),
      dashed: document.querySelectorAll('.leaders .leader')[i].classList.contains('hidden'),
    })),
  )

export const clouds = [
  [
    'points: the first view shows the dent, and flags that the part hides are hidden, at any size and once they are drawn',
    async (session) => {
      const counted = []
      for (const [width, height] of [[1280, 800], [1440, 900], [1000, 1300], [390, 844]]) {
        const page = await session.report('dent', { width, height })
        const { first, picks, result } = await manifest(page)
        assert.deepEqual(await shown(page), ['measured'])
        const places = picks.filter((p) => p.value !== null)
        // The worst of all comes first, whatever its sign.
        assert.ok(places[0].value < -0.4 && result.comparisons[0].worst[0].deviation === places[0].value)
        assert.ok(looksHere(places[0].position, first.toward), `${first.toward}`)
        for (const view of [null, '2', '6']) {
          if (view) await key(page, view)
          const toward = view ? { 2: [0, 1, 0], 6: [0, 0, -1] }[view] : first.toward
          const found = await flags(page)
          places.forEach((p, n) => {
            // Along a face both are right: noise lies before it and behind.
            const along = faceOf(p.position).every((x, k) => x * toward[k] === 0)
            if (!along) assert.equal(found[n].hidden, !looksHere(p.position, toward), `${width}, view ${view}: flag ${n + 1}`)
            assert.equal(found[n].dashed, found[n].hidden)
          })
          const hidden = found.filter((f) => f.hidden).length
          counted.push(hidden)
          if (hidden > 0) assert.match(await page.locator('#unseen').innerText(), new RegExp(`: ${hidden} / ${places.length}$`))
        }
        await session.tidy()
      }
      assert.ok(Math.max(...counted) > 0)
      // The stored picture says the same.
      const still = await session.report('dent', { scripts: false })
      const { first, picks } = JSON.parse(await still.locator('#manifest').textContent())
      const drawn = await still.locator('.flagged text').evaluateAll((all) => all.map((t) => ({ label: Number(t.textContent.split(/\s/)[0]), hidden: t.classList.contains('hidden') })))
      const places = picks.filter((p) => p.value !== null)
      assert.equal(drawn.length, places.length)
      for (const { label, hidden } of drawn) assert.equal(hidden, !looksHere(places[label - 1].position, first.toward), `flag ${label}`)
    },
  ],
  [
    'between points the cursor reads nothing of the far side, and the points close the surface',
    async (session) => {
      const page = await session.report('dent')
      await tool(page, 'Flags')
      const { first } = await manifest(page)
      const box = await stageBox(page)
      const perPixel = (await view(page)) / box.height
      const picture = await screen(page)
      const ground = picture.at(box.x + 4, box.y + box.height / 2)
      let [read_, places, closed] = [0, 0, 0]
      // Within the hexagon that the cube is seen as: 20 mm from its middle to a corner, over √(3/2).
      for (let i = 0; i < 240; i++) {
        const [r, a] = [11 * Math.sqrt(i / 240), i * 2.4]
        const [x, y] = [box.cx + (r * Math.cos(a)) / perPixel, box.cy + (r * Math.sin(a)) / perPixel]
        places++
        const color = picture.at(x, y)
        if (Math.max(...color.map((c, k) => Math.abs(c - ground[k]))) > 40) closed++
        await page.mouse.move(x, y)
        const { text } = await read(page)
        if (!text) continue
        read_++
        const xyz = text.match(/x (\S+) y (\S+) z (\S+)/).slice(1).map((n) => Number(n.replace('−', '-')))
        assert.ok(looksHere(xyz, first.toward), `${text} from ${first.toward}`)
      }
      assert.ok(read_ > 0.85 * places && closed > 0.97 * places, `${read_} read, ${closed} closed of ${places}`)
    },
  ],
  [
    'in the dark every colour of a scale stands out from the stage',
    async (session) => {
      const page = await session.report('dent', { colorScheme: 'dark' })
      const { palettes, scale } = await manifest(page)
      const stage = await page.evaluate(() => getComputedStyle(document.querySelector('canvas')).backgroundColor.match(/\d+/g).map(Number))
      const box = await stageBox(page)
      assert.deepEqual((await screen(page)).at(box.x + 4, box.y + box.height / 2), stage)
      const { bands } = palettes[scale.palette]
      const colors = bands.match(/.{6}/g).map((c) => [0, 2, 4].map((k) => parseInt(c.slice(k, k + 2), 16)))
      for (const color of colors) assert.ok(Math.hypot(...color.map((c, k) => c - stage[k])) > 80, `${color} on ${stage}`)
    },
  ],
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
        // The cursor is within a pixel of the worst point; the dent is deeper than 0.47 within half a millimeter, the noise 0.02.
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
      const worst = await page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent).result.comparisons[0].worst[0])
      assert.ok(worst.deviation < -0.2)
      await key(page, '5')
      const box = await stageBox(page)
      const perPixel = (await view(page)) / box.height
      await page.mouse.move(Math.round(box.cx + (worst.nearest[0] - 10) / perPixel), Math.round(box.cy - (worst.nearest[1] - 10) / perPixel))
      assert.ok(Math.abs(Number((await read(page)).value) - worst.deviation) < 1e-4)
    },
  ],
  [
    'a scratch narrower than the points are apart is seen from where one looks on its face, and from nowhere else',
    async (session) => {
      const page = await session.report('scratch')
      assert.deepEqual(await shown(page), ['measured'])
      await tool(page, 'Flat')
      await tool(page, 'Flags')
      await page.mouse.move(5, 5)
      const box = await stageBox(page)
      // Right and up in the model, for a look from above, from a corner, and from below.
      const [s2, s6] = [Math.sqrt(2), Math.sqrt(6)]
      const views = { 5: ([x, y]) => [x, y], 7: ([x, y, z]) => [(x + y) / s2, (2 * z - x + y) / s6], 6: ([x, y]) => [x, -y] }
      for (const [view_, flat] of Object.entries(views)) {
        await key(page, view_)
        const scale = box.height / (await view(page))
        const picture = await screen(page)
        let [found, all] = [0, 0]
        for (let x = 1; x < 19.1; x += 0.25) {
          const [right, up] = flat([x - 10, 0.2 * (x - 10), 9.4])
          const [i, j] = [Math.round(box.cx + right * scale), Math.round(box.cy - up * scale)]
          all++
          found += Number([-3, 0, 3].some((a) => [-3, 0, 3].some((b) => blue(picture.at(i + a, j + b)))))
        }
        // From below only through gaps between the points.
        if (view_ === '6') assert.ok(found < 0.1 * all, `from below: ${found} of ${all}`)
        else assert.ok(found > 0.75 * all, `view ${view_}: ${found} of ${all}`)
      }
      // The cursor reads what is seen.
      await key(page, '7')
      const scale = box.height / (await view(page))
      const read_ = []
      for (let x = 4; x < 16.1; x += 1) {
        const [right, up] = views[7]([x - 10, 0.2 * (x - 10), 9.4])
        await page.mouse.move(Math.round(box.cx + right * scale), Math.round(box.cy - up * scale))
        read_.push(Number((await read(page)).value))
      }
      assert.ok(read_.filter((v) => v < -0.4).length > 0.5 * read_.length, read_.join(' '))
    },
  ],
  [
    'a million points on 346 thousand facets: places show values of real points, and single bad ones are seen',
    async (session) => {
      const page = await session.report('dense')
      const { objects } = await manifest(page)
      assert.deepEqual(objects.map((o) => o.source_vertices), [1_000_000, 173_402])
      await tool(page, 'Flat')
      await tool(page, 'Flags')
      for (const reference of [false, true]) {
        if (reference) await onReference(page)
        await key(page, '5')
        await page.mouse.move(5, 5)
        const box = await stageBox(page)
        const perPixel = (await view(page)) / box.height
        const at = (x, y) => [Math.round(box.cx + (x - 10) / perPixel), Math.round(box.cy - (y - 10) / perPixel)]
        const picture = await screen(page)
        for (const x of [4, 7, 10, 13, 16]) {
          for (const y of [4, 7, 10, 13, 16]) {
            const [i, j] = at(x, y)
            const near = [-2, -1, 0, 1, 2].flatMap((a) => [-2, -1, 0, 1, 2].map((b) => picture.at(i + a, j + b)))
            assert.ok(near.some(blue), `the point 0.3 mm under ${x}, ${y} is not seen (reference: ${reference})`)
            // On the reference the nearest vertex shows it, up to half a facet away.
            const found = []
            for (const [a, b] of [[0, 0], [2, 0], [-2, 0], [0, 2], [0, -2], [2, 2], [-2, -2], [2, -2], [-2, 2]].slice(0, reference ? 9 : 1)) {
              await page.mouse.move(i + a, j + b)
              found.push(Number((await read(page)).value))
            }
            assert.ok(found.some((v) => Math.abs(v + 0.3) < 1e-3), `${found} at ${x}, ${y} (reference: ${reference})`)
            // Between them no place is colored, and none shows what no point has: a mean would lie between.
            const [k, l] = at(x + 1.5, y + 1.5)
            assert.ok(!out(picture.at(k, l)), `${x + 1.5}, ${y + 1.5}`)
            await page.mouse.move(k, l)
            const good = await read(page)
            if (good.text) assert.ok(Math.abs(Math.abs(Number(good.value)) - 0.02) < 1e-3, good.text)
          }
        }
      }
      assert.deepEqual(page.seen.errors, [])
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
  [
    'points: faces that turn away from the eye are darker, so that the form shows',
    async (session) => {
      const page = await session.report('dent', { width: 1000, height: 800 })
      await key(page, '7')
      const box = await stageBox(page)
      await page.mouse.move(box.cx, box.cy)
      await page.mouse.down()
      await page.mouse.move(box.cx + 120, box.cy + 90, { steps: 6 })
      await page.mouse.up()
      await settled(page)
      const picture = await screen(page)
      const green = (c) => c[1] > c[0] + 30 && c[1] > c[2] + 30
      const means = []
      for (let x = box.cx - 200; x < box.cx + 200; x += 16)
        for (let y = box.cy - 200; y < box.cy + 200; y += 16) {
          const all = []
          for (let i = 0; i < 16; i++) for (let j = 0; j < 16; j++) all.push(picture.at(x + i, y + j))
          if (all.every(green)) means.push(all.reduce((sum, c) => sum + c[1], 0) / all.length)
        }
      means.sort((a, b) => a - b)
      assert.ok(means.length > 40, `${means.length} places`)
      const [low, high] = [0.1, 0.9].map((q) => means[Math.floor(q * means.length)])
      assert.ok(high > 1.12 * low, `all faces alike: ${low} … ${high}`)
    },
  ],
  [
    'paper: where everything is switched off, the picture shows the reference',
    async (session) => {
      const page = await session.report('dent')
      await tool(page, 'Measured')
      await settled(page)
      const src = await page.evaluate(() => {
        window.dispatchEvent(new Event('beforeprint'))
        return document.getElementById('picture').src
      })
      const picture = decode(Buffer.from(src.split(',')[1], 'base64'))
      let drawn = 0
      for (let x = 0; x < picture.width; x += 10) for (let y = 0; y < picture.height; y += 10) drawn += Number(picture.at(x, y).some((c) => c < 240))
      assert.ok(drawn > 0.05 * (picture.width / 10) * (picture.height / 10), `${drawn} of the picture's pixels are drawn`)
      // On the screen it stays as the reader left it.
      assert.equal(await page.evaluate(() => document.querySelector('.stage-tools button[aria-pressed=true]')?.textContent.includes('Reference') ?? false), false)
    },
  ],
]
