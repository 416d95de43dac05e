// The first view: the worst place is seen, what is hidden is never drawn as visible, and what lies off the part says so.
import assert from 'node:assert/strict'
import { settled, stageBox } from '../browser.mjs'

/** A place is this far under a surface, millimeters, before the sphere's own rounding counts. */
const NEAR = 0.3
const manifest = (page) => page.evaluate(() => JSON.parse(document.getElementById('manifest').textContent))
const flags = (page) =>
  page.evaluate(() =>
    [...document.querySelectorAll('.flag')].map((box, i) => {
      const leader = document.querySelectorAll('.leaders .leader')[i]
      return { text: box.textContent, hidden: box.classList.contains('hidden'), dashed: leader.classList.contains('hidden'), x: Number(leader.getAttribute('x2')), y: Number(leader.getAttribute('y2')) }
    }),
  )
/** Whether a place on a sphere about the origin looks to the reader. */
const looksHere = (place, toward) => place.reduce((sum, x, k) => sum + x * toward[k], 0) > NEAR

/** Counts the flags drawn as visible at every change of the page, and when the first was drawn. */
const watch = () => {
  window.drawn = []
  const look = () => {
    const flags = [...document.querySelectorAll('.flag')]
    if (flags.length && document.querySelector('.stage.live')) window.drawn.push(flags.map((f) => !f.classList.contains('hidden')))
    requestAnimationFrame(look)
  }
  requestAnimationFrame(look)
}

export const first = [
  [
    'the first view shows the worst place, wherever it looks, and says how many it does not show',
    async (session) => {
      const page = await session.report('behind')
      const { first, picks } = await manifest(page)
      const worst = picks.findIndex((p) => !p.off && p.value === Math.max(...picks.filter((q) => !q.off && q.value !== null).map((q) => q.value)))
      assert.ok(picks[worst].position[1] > 0 && picks[worst].position[0] < 0, 'it looks away from the usual view')
      assert.ok(looksHere(picks[worst].position, first.toward), `${first.toward}`)
      const valued = picks.filter((p) => p.value !== null)
      const shown = await flags(page)
      valued.forEach((p, n) => {
        if (!p.off) assert.equal(shown[n].hidden, !looksHere(p.position, first.toward), shown[n].text)
        assert.equal(shown[n].hidden, shown[n].dashed)
      })
      const hidden = first.places.filter((n) => !picks[n].off && !looksHere(picks[n].position, first.toward)).length
      assert.ok(hidden > 0, 'no view shows all of them')
      assert.match(await page.locator('#unseen').innerText(), new RegExp(`: ${hidden} / ${first.places.length}$`))
      // As many as any other of eighty views does.
      const all = first.places.map((n) => picks[n]).filter((p) => !p.off)
      const seen = (toward) => all.filter((p) => looksHere(p.position, toward)).length
      for (let i = 0; i < 80; i++) {
        const [z, a] = [1 - (2 * i + 1) / 80, i * 2.4]
        const r = Math.sqrt(1 - z * z)
        const other = [r * Math.cos(a), r * Math.sin(a), z]
        if (looksHere(picks[worst].position, other)) assert.ok(seen(other) <= seen(first.toward) + 1, `${other}: ${seen(other)}`)
      }
    },
  ],
  [
    'the stored picture has the numbers of the flags at their places, without scripts',
    async (session) => {
      const page = await session.report('behind', { scripts: false })
      const texts = await page.locator('.flagged text').allTextContents()
      const { picks } = JSON.parse(await page.locator('#manifest').textContent())
      assert.equal(texts.length, picks.filter((p) => p.value !== null).length)
      assert.ok(texts.some((t) => /^1\s*\+30\.000 off the part/.test(t)), texts.join(' | '))
      assert.ok(await page.locator('.flagged').isVisible())
      assert.match(await page.locator('#unseen').innerText(), /hidden in this view: \d+ \/ \d+/)
    },
  ],
  [
    'a hidden flag is never drawn as visible, from the first frame and while turning',
    async (session) => {
      const page = await session.report('behind', { init: watch })
      const { first, picks } = await manifest(page)
      const hidden = picks.filter((p) => p.value !== null).map((p) => !p.off && !looksHere(p.position, first.toward))
      const frames = await page.evaluate(() => window.drawn)
      assert.ok(frames.length > 0)
      for (const visible of frames) hidden.forEach((h, n) => assert.ok(!(h && visible[n]), `flag ${n + 1} of ${visible}`))
      // Turned by half a turn without a pause: what was in front is behind, and is known to be before any value is read.
      const front = picks.filter((p) => p.value !== null).findIndex((p) => !p.off && looksHere(p.position, first.toward.map((x) => 3 * x)) && Math.abs(p.position[2]) < 7)
      const state = await page.evaluate((n) => {
        const canvas = document.querySelector('canvas')
        for (let i = 0; i < 12; i++) canvas.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight' }))
        return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done({ busy: canvas.ariaBusy, hidden: document.querySelectorAll('.flag')[n].classList.contains('hidden') }))))
      }, front)
      assert.deepEqual(state, { busy: 'true', hidden: true })
    },
  ],
  [
    'a place off the part has its flag there, on the stage, with the way to the part',
    async (session) => {
      const page = await session.report('behind')
      await page.keyboard.press('1')
      await settled(page)
      const box = await stageBox(page)
      const found = await page.evaluate(() => {
        const [way] = document.querySelectorAll('.leaders .way')
        const at = (name) => Number(way.getAttribute(name))
        return { x1: at('x1'), y1: at('y1'), x2: at('x2'), y2: at('y2') }
      })
      const [flag] = await flags(page)
      assert.match(flag.text, /\+30\.000off the part/)
      assert.ok(!flag.hidden)
      assert.ok(Math.hypot(flag.x - found.x1, flag.y - found.y1) < 1)
      assert.ok(flag.y > 0 && flag.y < found.y2 - 100 && found.y2 < box.height, `${flag.y} over ${found.y2}`)
      assert.ok(Math.abs(found.x1 - found.x2) < 1)
    },
  ],
  [
    'a check looks at the largest defect, on the back and below',
    async (session) => {
      const page = await session.report('torn')
      const { first, picks, result } = await manifest(page)
      const largest = picks[first.places[0]]
      const holes = result.defects.holes.items.toSorted((a, b) => b.size - a.size)
      assert.ok(largest.reach > 3 * picks[first.places[7]].reach)
      assert.deepEqual(largest.position, holes[0].position)
      assert.ok(largest.position[0] < 0 && largest.position[1] > 0 && largest.position[2] < 0)
      assert.ok(looksHere(largest.position, first.toward), `${first.toward}`)
    },
  ],
  [
    'a check opens from where its faults are seen, not only facets that have them; and the script says of them what the page said',
    async (session) => {
      const still = await session.report('pushed', { scripts: false })
      const said = (await still.locator('#unseen').textContent()).match(/(\d+) \/ (\d+)/).slice(1).map(Number)
      assert.ok(said[1] > 1 && said[0] < said[1], `${said}`)
      const page = await session.report('pushed')
      const { first, picks } = await manifest(page)
      // The places lie in the bottom, over which there is the rest of the cube.
      for (const n of first.places) assert.ok(Math.abs(picks[n].position[2]) < 1e-6, `${picks[n].position}`)
      assert.ok(first.toward[2] < 0, `${first.toward}`)
      const live = (await page.locator('#unseen').textContent()).match(/(\d+) \/ (\d+)/).slice(1).map(Number)
      assert.deepEqual(live, said)
    },
  ],
]
