// A browser without a network, pages opened from disk, and pixels as they are on the screen.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { inflateSync } from 'node:zlib'
import { join } from 'node:path'
import { pathToFileURL } from 'node:url'
import { chromium } from 'playwright-core'

const FLAGS = [
  '--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
  '--disable-sync', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
]

export async function open(executablePath, folder) {
  const browser = await chromium.launch({ executablePath, headless: true, args: FLAGS })
  const contexts = []
  const edited = mkdtempSync(join(tmpdir(), 'trueness-edited-'))
  /** A copy of a report with other numbers, names or words in it. */
  const copy = (name, edit) => {
    writeFileSync(join(edited, `${name}.html`), edit(readFileSync(join(folder, `${name}.html`), 'utf8')))
    return edited
  }
  return {
    folder,
    /** A page with what it asked for and complained about in `page.seen`; `edit` makes of the report's text that of another. */
    async report(name, { width = 1280, height = 800, scripts = true, init, edit, hash = '', live = true, ...rest } = {}) {
      const context = await browser.newContext({ viewport: { width, height }, javaScriptEnabled: scripts, ...rest })
      contexts.push(context)
      // Software rendering on a busy machine is slow, and slow is not wrong.
      context.setDefaultTimeout(120_000)
      const page = await context.newPage()
      page.seen = { requests: [], errors: [], dialogs: 0 }
      page.on('request', (r) => page.seen.requests.push(r.url()))
      page.on('console', (m) => m.type() === 'error' && page.seen.errors.push(m.text()))
      page.on('pageerror', (e) => page.seen.errors.push(e.message))
      page.on('dialog', (d) => (page.seen.dialogs++, d.dismiss()))
      if (scripts)
        await page.addInitScript(() => {
          window.violations = []
          document.addEventListener('securitypolicyviolation', (e) => window.violations.push(e.violatedDirective))
        })
      if (init) await page.addInitScript(init)
      await page.goto(pathToFileURL(join(edit ? copy(name, edit) : folder, `${name}.html`)).href + hash)
      if (scripts && live) await settled(page)
      return page
    },
    async tidy() {
      await Promise.all(contexts.splice(0).map((c) => c.close()))
    },
    async close() {
      await browser.close()
      rmSync(edited, { recursive: true })
    },
  }
}

/** Waits until the part is shown and the values under the cursor can be read. */
export async function settled(page) {
  await page.waitForSelector('.stage.live', { timeout: 120_000 })
  await page.waitForSelector('canvas[aria-busy=false]', { timeout: 120_000 })
}

/** Pixels of the screen as `at(x, y) → [r, g, b]`. */
export async function screen(page) {
  return decode(await page.screenshot())
}

/** Decodes a PNG of 8-bit colors without interlacing. */
export function decode(png) {
  const chunks = []
  let width, height, channels
  for (let at = 8; at < png.length; ) {
    const size = png.readUInt32BE(at)
    const kind = png.toString('latin1', at + 4, at + 8)
    const data = png.subarray(at + 8, at + 8 + size)
    if (kind === 'IHDR') [width, height, channels] = [data.readUInt32BE(0), data.readUInt32BE(4), data[9] === 6 ? 4 : 3]
    if (kind === 'IDAT') chunks.push(data)
    at += 12 + size
  }
  const raw = inflateSync(Buffer.concat(chunks))
  const row = width * channels
  const out = Buffer.alloc(row * height)
  for (let y = 0; y < height; y++) {
    const filter = raw[y * (row + 1)]
    for (let x = 0; x < row; x++) {
      const left = x >= channels ? out[y * row + x - channels] : 0
      const up = y > 0 ? out[(y - 1) * row + x] : 0
      const corner = y > 0 && x >= channels ? out[(y - 1) * row + x - channels] : 0
      const base = left + up - corner
      const [a, b, c] = [left, up, corner].map((v) => Math.abs(base - v))
      const paeth = a <= b && a <= c ? left : b <= c ? up : corner
      const predicted = [0, left, up, (left + up) >> 1, paeth][filter]
      out[y * row + x] = raw[y * (row + 1) + 1 + x] + predicted
    }
  }
  return {
    width,
    height,
    at(x, y) {
      const p = Math.round(y) * row + Math.round(x) * channels
      return [out[p], out[p + 1], out[p + 2]]
    },
  }
}

export const hex = (c) => `#${c.map((x) => x.toString(16).padStart(2, '0')).join('')}`

export function near(a, b, tolerance) {
  return a.every((x, k) => Math.abs(x - b[k]) <= tolerance)
}

/** Presses a button of the stage's toolbar by its number of the text table's English word. */
export const tool = (page, word) => page.locator('.stage-tools button', { hasText: word }).first().click()

/** Middle of the stage and its box on the screen. */
export async function stageBox(page) {
  const box = await page.locator('canvas').boundingBox()
  return { ...box, cx: box.x + box.width / 2, cy: box.y + box.height / 2 }
}
