// Flags and their leaders: which belongs to what can be seen.
import assert from 'node:assert/strict'
import { settled } from '../browser.mjs'

/** Boxes of the flags that are shown and lines of the leaders, in pixels of the stage. */
const laidOut = (page) =>
  page.evaluate(() => {
    const shown = (e) => !e.classList.contains('left-out')
    const at = (line) => ['x1', 'y1', 'x2', 'y2'].map((name) => Number(line.getAttribute(name)))
    const stage = document.querySelector('.overlay').getBoundingClientRect()
    const lines = [...document.querySelectorAll('.leaders .leader')]
    const stubs = [...document.querySelectorAll('.leaders .stub')]
    return [...document.querySelectorAll('.flag')].map((flag, i) => {
      const b = flag.getBoundingClientRect()
      const leaders = [lines[i], stubs[i]].filter((l) => l && shown(l)).map(at)
      return { shown: shown(flag), name: flag.textContent, box: [b.left - stage.left, b.top - stage.top, b.right - stage.left, b.bottom - stage.top], leaders }
    })
  })

/** A line runs through the inner part of a box. */
function through([x1, y1, x2, y2], [left, top, right, bottom]) {
  for (let i = 0; i <= 400; i++) {
    const t = i / 400
    const [x, y] = [x1 + t * (x2 - x1), y1 + t * (y2 - y1)]
    if (x > left + 1 && x < right - 1 && y > top + 1 && y < bottom - 1) return true
  }
  return false
}

async function clear(page, what) {
  const flags = (await laidOut(page)).filter((f) => f.shown)
  assert.ok(flags.length > 0)
  for (const flag of flags)
    for (const leader of flag.leaders)
      for (const other of flags) if (other !== flag) assert.ok(!through(leader, other.box), `${what}: the leader of ${flag.name} runs behind ${other.name}`)
}

export const flags = [
  [
    'no leader runs behind the flag of another place, from any side, near and far',
    async (session) => {
      for (const name of ['plan', 'behind', 'dent']) {
        const page = await session.report(name, { width: 1440, height: 900 })
        await clear(page, name)
        for (const view of ['1', '5']) {
          await page.keyboard.press(view)
          await settled(page)
          await clear(page, `${name}, view ${view}`)
        }
        // Nearer, until places lie beneath the columns and beside the stage.
        for (let i = 0; i < 2; i++) {
          await page.keyboard.press('+')
          await settled(page)
          await clear(page, `${name}, nearer ${i + 1}`)
        }
        await session.tidy()
      }
    },
  ],
  [
    'frames of characteristics lie beside the part, however wide they are',
    async (session) => {
      const page = await session.report('plan', { width: 1440, height: 900 })
      const edge = await page.evaluate(() => {
        const boxes = [...document.querySelectorAll('.flag:not(.left-out)')].map((f) => f.getBoundingClientRect())
        const stage = document.querySelector('.overlay').getBoundingClientRect()
        const middle = stage.left + stage.width / 2
        return { left: Math.max(stage.left, ...boxes.filter((b) => b.left < middle).map((b) => b.right)) - stage.left, right: Math.min(stage.right, ...boxes.filter((b) => b.left > middle).map((b) => b.left)) - stage.left, ends: [...document.querySelectorAll('.leaders .leader:not(.left-out)')].map((l) => Number(l.getAttribute('x2'))) }
      })
      for (const x of edge.ends) assert.ok(x > edge.left && x < edge.right, `${x} beneath ${edge.left} or ${edge.right}`)
    },
  ],
]
